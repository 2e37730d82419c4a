#include "info/print_certificate.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "info/table.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

using verify::CertifiedCell;
using verify::ShapeBounds;
using verify::ShapeCertificate;

/// Formats a bound with six digits, rounded outward: down, or up for an upper bound. A relative
/// difference that the error of the bound explains is ignored.
std::string shown_bound(double bound, bool is_upper) {
    constexpr double slack = 10 * verify::relative_error_of_bounds;
    if (bound == 0) return shown(bound);
    const double inner = is_upper ? bound * (1 - slack) : bound * (1 + slack);
    const double unit = std::pow(10, std::floor(std::log10(bound)) - 5);
    return shown((is_upper ? std::ceil(inner / unit) : std::floor(inner / unit)) * unit);
}
std::string shown_lower(double bound) { return shown_bound(bound, false); }
std::string shown_upper(double bound) { return shown_bound(bound, true); }

quality::Histogram histogram_of(const ShapeCertificate& certificate) {
    const auto& counts = certificate.dihedral_histogram;
    quality::Histogram histogram(
        0, ShapeCertificate::bin_width * static_cast<double>(counts.size()), counts.size());
    histogram.counts.assign(counts.begin(), counts.end());
    return histogram;
}

double mean_shapes(const ShapeCertificate& certificate) {
    return static_cast<double>(certificate.sum_of_shapes) / static_cast<double>(certificate.cells);
}

void add_cells(Table& table, const ShapeCertificate& found) {
    table.heading("Cells", "count");
    table.row("cells", shown(found.cells));
    table.row("closed sets of shapes", shown(found.closed_cells));
    table.row("open at the limit", shown(found.cells - found.closed_cells));
    table.row("with equal lengths", shown(found.cells_with_ties));
    table.row("with nearly equal lengths", shown(found.cells_with_near_ties));
}

void add_sets(Table& table, const ShapeCertificate& found) {
    table.heading("Set of a cell", "minimum", "maximum", "mean");
    table.row("shapes", shown(found.min_shapes), shown(found.max_shapes),
              shown(mean_shapes(found)));
    table.row("generations until closed", "", shown(std::size_t{found.max_generations}));
}

void add_bounds(Table& table, const ShapeBounds& bounds) {
    table.heading("Proved bounds", "minimum", "maximum");
    table.row("dihedral angle, degrees", shown_lower(bounds.min_dihedral),
              shown_upper(bounds.max_dihedral));
    table.row("eta (regular: 1)", shown_lower(bounds.min_eta));
    table.row("solid angle, sr", shown_lower(bounds.min_solid));
}

void add_worst(Table& table, const ShapeCertificate& found, std::uint32_t index_base) {
    table.heading("Worst cells", "least angle", "shapes", "generations");
    for (const CertifiedCell& cell : found.worst) {
        const auto& [x, y, z] = cell.centroid;
        const verify::CellCertificate& of_cell = cell.certificate;
        const std::string generations = std::to_string(of_cell.generations);
        table.row(fmt::format("cell {}", cell.cell + index_base),
                  shown_lower(of_cell.bounds.min_dihedral), shown(of_cell.shapes),
                  of_cell.is_closed ? generations : "open at " + generations);
        table.row(fmt::format("  at {}, {}, {}", shown(x), shown(y), shown(z)));
    }
}

nlohmann::ordered_json json(const ShapeBounds& bounds) {
    return {{"min_dihedral", bounds.min_dihedral},
            {"max_dihedral", bounds.max_dihedral},
            {"min_eta", bounds.min_eta},
            {"min_solid", bounds.min_solid}};
}

nlohmann::ordered_json json(const CertifiedCell& cell, std::uint32_t index_base) {
    const verify::CellCertificate& found = cell.certificate;
    return {{"cell", cell.cell + index_base},
            {"centroid", {cell.centroid.x, cell.centroid.y, cell.centroid.z}},
            {"shapes", found.shapes},
            {"placements", found.placements},
            {"generations", found.generations},
            {"closed", found.is_closed},
            {"bounds", json(found.bounds)}};
}

}  // namespace

void print_certificate(const ShapeCertificate& certificate, const std::string& path,
                       std::uint32_t index_base) {
    if (certificate.cells == 0) return print("{}: no cells\n", path);
    Table table;
    add_cells(table, certificate);
    add_sets(table, certificate);
    add_bounds(table, certificate.bounds);
    add_worst(table, certificate, index_base);
    table.histogram("Least angle of a cell, degrees", histogram_of(certificate));
    print_text(std::move(table).take());
    const std::string until =
        certificate.is_closed()
            ? "at any level of any regular refinement, up to the rounding of midpoints"
            : fmt::format("to generation {} of regular refinement; --limit can close more sets",
                          *certificate.holds_to_generation);
    print("\n{}: dihedral angles are {} to {} degrees\n{}\n", path,
          shown_lower(certificate.bounds.min_dihedral),
          shown_upper(certificate.bounds.max_dihedral), until);
}

void print_certificate_json(const ShapeCertificate& certificate, std::uint32_t index_base) {
    const bool has_cells = certificate.cells > 0;
    const quality::Histogram histogram = histogram_of(certificate);
    nlohmann::ordered_json out{
        {"cells",
         {{"total", certificate.cells},
          {"closed", certificate.closed_cells},
          {"with_ties", certificate.cells_with_ties},
          {"with_near_ties", certificate.cells_with_near_ties}}},
        {"shapes", nullptr},
        {"max_generations", certificate.max_generations},
        {"holds_to_generation", nullptr},
        {"bounds", nullptr},
        {"worst", nlohmann::ordered_json::array()},
        {"dihedral_histogram",
         {{"low", histogram.low}, {"high", histogram.high}, {"counts", histogram.counts}}}};
    if (has_cells) {
        out["shapes"] = {{"min", certificate.min_shapes},
                         {"max", certificate.max_shapes},
                         {"mean", mean_shapes(certificate)}};
        out["bounds"] = json(certificate.bounds);
    }
    if (certificate.holds_to_generation) {
        out["holds_to_generation"] = *certificate.holds_to_generation;
    }
    for (const CertifiedCell& cell : certificate.worst) {
        out["worst"].push_back(json(cell, index_base));
    }
    print_text(out.dump(2) + "\n");
}

}  // namespace octetra::cli
