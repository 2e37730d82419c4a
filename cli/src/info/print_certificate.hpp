#pragma once

#include <cstdint>
#include <string>

#include <octetra/verify/certify_shapes.hpp>

/// Output of a certificate of shapes as a table or JSON.
///
/// The JSON text is one object. Names are stable; new ones may be added. Numbers are printed such
/// that they read back to the same bits. Angles are in degrees, solid angles in steradians.
///
///     cells                {total, closed, with_ties, with_near_ties}
///     shapes               {min, max, mean} of a cell, up to similarity; null without cells
///     max_generations      of closed sets
///     holds_to_generation  null if all sets are closed
///     bounds               {min_dihedral, max_dihedral, min_eta, min_solid}, rounded outward; null
///                          without cells
///     worst                [{cell, centroid: [x, y, z], shapes, placements, generations, closed,
///                          bounds}, ...], least dihedral angle first
///     dihedral_histogram   {low, high, counts: [...]}: cells by their least dihedral angle
namespace octetra::cli {

/// Prints lines of at most 80 columns, with numbers of six significant digits.
void print_certificate(const verify::ShapeCertificate& certificate, const std::string& path,
                       std::uint32_t index_base);
void print_certificate_json(const verify::ShapeCertificate& certificate, std::uint32_t index_base);

}  // namespace octetra::cli
