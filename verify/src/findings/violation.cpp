#include <octetra/verify/violation.hpp>

namespace octetra::verify {

std::string_view name(Code code) {
    static constexpr std::array<std::string_view, code_count> names{"vertex_out_of_range",
                                                                    "list_length",
                                                                    "not_finite",
                                                                    "repeated_vertex",
                                                                    "repeated_cell",
                                                                    "unused_vertex",
                                                                    "coincident_vertices",
                                                                    "stray_facet",
                                                                    "stray_edge",
                                                                    "conflicting_markers",
                                                                    "inverted_cell",
                                                                    "flat_cell",
                                                                    "face_of_many_cells",
                                                                    "cells_on_one_side",
                                                                    "hanging_vertex",
                                                                    "vertex_in_cell",
                                                                    "boundary_crosses",
                                                                    "lost_vertex",
                                                                    "not_a_midpoint",
                                                                    "not_tiled",
                                                                    "cell_of_no_parent",
                                                                    "open_face",
                                                                    "boundary_moved",
                                                                    "wrong_volume",
                                                                    "wrong_sum",
                                                                    "wrong_parent",
                                                                    "wrong_midpoint_edge",
                                                                    "wrong_region",
                                                                    "wrong_facet_marker",
                                                                    "missing_facet",
                                                                    "extra_facet",
                                                                    "wrong_edge_marker",
                                                                    "missing_edge",
                                                                    "extra_edge",
                                                                    "wrong_vertex_marker",
                                                                    "wrong_attribute",
                                                                    "face_angle_too_small",
                                                                    "dihedral_too_small",
                                                                    "needless_bisection",
                                                                    "missing_bisection",
                                                                    "wrong_pattern"};
    return names[static_cast<std::size_t>(code)];
}

}  // namespace octetra::verify
