#pragma once

// Laplace's equation with a re-entrant edge, and its discretisation with linear elements.
//
// Domain: ((-1,1)^2 without [0,1) x (-1,0]) x (0,1). Solution: u = r^(2/3) sin(2 theta / 3), whose
// gradient has no bound at the edge r = 0. Dirichlet conditions on the sides, natural ones on z = 0
// and 1.
#include <petscksp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;
using octetra::CellIndex;
using octetra::CellVertices;
using octetra::Point;
using octetra::VertexIndex;

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector from_to(const Point& a, const Point& b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }

// ---- the problem --------------------------------------------------------------------------------

inline double angle(const Point& p) {
    const double theta = std::atan2(p.y, p.x);
    return theta < 0 ? theta + 2 * std::numbers::pi : theta;
}
inline double solution(const Point& p) {
    return std::pow(std::hypot(p.x, p.y), 2.0 / 3) * std::sin(2 * angle(p) / 3);
}
inline Vector gradient(const Point& p) {
    const double r = std::hypot(p.x, p.y);
    const double theta = angle(p);
    const double size = 2.0 / 3 * std::pow(r, -1.0 / 3);
    // d/dr and 1/r d/dtheta, transformed to x and y.
    return {-size * std::sin(theta / 3), size * std::cos(theta / 3), 0};
}
inline bool is_natural(const std::array<Point, 3>& face) {
    const auto all_at = [&](double z) {
        return std::ranges::all_of(face, [&](const Point& p) { return p.z == z; });
    };
    return all_at(0) || all_at(1);
}

// Cubes of side 1/2, six cells each, on the first process.
inline octetra::Mesh coarse_mesh() {
    octetra::Mesh mesh;
    constexpr std::array<int, 3> count{5, 5, 3};
    std::vector<std::uint32_t> number(5 * 5 * 3, VertexIndex::none_value);
    const auto vertex = [&](const std::array<int, 3>& p) {
        auto& n = number[static_cast<std::size_t>((p[2] * count[1] + p[1]) * count[0] + p[0])];
        if (n == VertexIndex::none_value) {
            n = mesh.points.append({p[0] / 2.0 - 1, p[1] / 2.0 - 1, p[2] / 2.0}).value();
        }
        return VertexIndex{n};
    };
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                if (i >= 2 && j < 2) continue;  // the notch
                std::array<std::size_t, 3> axes{0, 1, 2};
                do {  // from one corner of the cube to the other, axis by axis
                    std::array<int, 3> p{i, j, k};
                    CellVertices cell;
                    cell[0] = vertex(p);
                    for (std::size_t a = 0; a < 3; ++a) {
                        ++p[axes[a]];
                        cell[a + 1] = vertex(p);
                    }
                    const bool is_even = (axes[0] + 1) % 3 == axes[1];
                    if (!is_even) std::swap(cell[2], cell[3]);  // opposite orientation
                    mesh.cells.push_back(cell);
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
        }
    }
    return mesh;
}

inline od::AdaptiveMesh distributed_mesh() {
    const od::Communicator processes = od::communicator_of(PETSC_COMM_WORLD);
    octetra::Mesh coarse;
    std::vector<int> ranks;
    if (processes.is_first()) {
        coarse = coarse_mesh();
        ranks = od::partition_cells(coarse, processes.size(), {});
    }
    return od::AdaptiveMesh::distribute(processes, std::move(coarse), ranks);
}

// ---- geometry of a cell -------------------------------------------------------------------------

struct CellGeometry {
    double volume = 0;
    std::array<Vector, 4> gradients{};  // gradients of the four hat functions

    explicit CellGeometry(const std::array<Point, 4>& p) {
        volume = dot(cross(from_to(p[0], p[1]), from_to(p[0], p[2])), from_to(p[0], p[3])) / 6;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto [a, b, c] = octetra::cell_faces[i];
            Vector normal = cross(from_to(p[a], p[b]), from_to(p[a], p[c]));
            const double height = dot(normal, from_to(p[a], p[i]));
            for (double& x : normal) x /= height;
            gradients[i] = normal;
        }
    }
};

inline std::array<Point, 4> corners_of(const od::AdaptiveMesh& mesh, std::size_t cell) {
    std::array<Point, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points()[mesh.cells()[cell][k].value()];
    return corners;
}
inline std::array<Point, 3> face_of(const std::array<Point, 4>& corners, std::size_t face) {
    const auto [a, b, c] = octetra::cell_faces[face];
    return {corners[a], corners[b], corners[c]};
}

// ---- solve --------------------------------------------------------------------------------------

// The numbering required by PETSc: vertices owned by a process have consecutive numbers.
struct Dofs {
    std::vector<PetscInt> number;  // number of each vertex of this process
    std::vector<std::size_t> own;  // the vertices owned by this process
};

inline Dofs number_dofs(const od::AdaptiveMesh& mesh) {
    const od::IndexMap<VertexIndex> map =
        od::make_index_map(mesh.processes(), mesh.vertex_sharing(), mesh.points().size());
    Dofs dofs;
    dofs.number.assign(map.numbers.begin(), map.numbers.end());
    for (std::size_t k = 0; k < map.owned_count; ++k) {
        dofs.own.push_back(map.entities[k].value());
    }
    return dofs;
}

// Returns nonzero for vertices on the sides. A process may have a vertex on the boundary without
// having a face there.
inline std::vector<std::uint8_t> on_sides(const od::AdaptiveMesh& mesh) {
    std::vector<std::uint8_t> flags(mesh.points().size(), 0);
    for (const auto& [cell, face] : mesh.boundary()) {
        if (is_natural(face_of(corners_of(mesh, cell.value()), face))) continue;
        for (const auto k : octetra::cell_faces[face]) {
            flags[mesh.cells()[cell.value()][k].value()] = 1;
        }
    }
    od::combine_everywhere(mesh.processes(), mesh.vertex_sharing(), flags.size(), flags,
                           std::logical_or<>{});
    return flags;
}

// The matrix, the right-hand side, and a vector with the boundary values, which becomes the
// solution.
struct System {
    Mat matrix = nullptr;
    Vec right = nullptr;
    Vec unknown = nullptr;

    System() = default;
    ~System() {
        VecDestroy(&unknown);
        VecDestroy(&right);
        MatDestroy(&matrix);
    }
    System(const System&) = delete;
    System& operator=(const System&) = delete;
};

// Bounds for the number of entries of each row that this process owns, in its own columns and in
// those of others: a vertex has an entry for itself and one for each edge.
inline std::array<std::vector<PetscInt>, 2> row_lengths(const od::AdaptiveMesh& mesh,
                                                        const Dofs& dofs) {
    const auto& sharing = mesh.vertex_sharing();
    std::vector<PetscInt> edges(mesh.points().size(), 1);
    std::vector<PetscInt> to_others(mesh.points().size(), 0);
    for (const auto& [a, b] : mesh.number_edges().vertices) {
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
            ++edges[from.value()];
            if (!sharing.is_owned(to)) ++to_others[from.value()];
        }
    }
    od::combine_everywhere(mesh.processes(), sharing, edges.size(), edges, std::plus<>{});
    for (const auto& with : sharing.neighbours()) {  // other processes may have further edges
        for (const VertexIndex v : with.entities) to_others[v.value()] = edges[v.value()];
    }
    std::array<std::vector<PetscInt>, 2> lengths;
    const auto own = static_cast<PetscInt>(dofs.own.size());
    for (const std::size_t v : dofs.own) {
        lengths[0].push_back(std::min(edges[v], own));
        lengths[1].push_back(to_others[v]);
    }
    return lengths;
}

inline void assemble(const od::AdaptiveMesh& mesh, const Dofs& dofs, System& system) {
    const auto own = static_cast<PetscInt>(dofs.own.size());
    const auto [own_lengths, other_lengths] = row_lengths(mesh, dofs);
    MatCreateAIJ(PETSC_COMM_WORLD, own, own, PETSC_DETERMINE, PETSC_DETERMINE, 0,
                 own_lengths.data(), 0, other_lengths.data(), &system.matrix);
    MatSetOption(system.matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE);
    VecCreateMPI(PETSC_COMM_WORLD, own, PETSC_DETERMINE, &system.right);
    VecDuplicate(system.right, &system.unknown);
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const CellGeometry geometry(corners_of(mesh, c));
        std::array<PetscInt, 4> rows{};
        std::array<PetscScalar, 16> values{};
        for (std::size_t i = 0; i < 4; ++i) {
            rows[i] = dofs.number[mesh.cells()[c][i].value()];
            for (std::size_t j = 0; j < 4; ++j) {
                values[4 * i + j] =
                    geometry.volume * dot(geometry.gradients[i], geometry.gradients[j]);
            }
        }
        MatSetValues(system.matrix, 4, rows.data(), 4, rows.data(), values.data(), ADD_VALUES);
    }
    MatAssemblyBegin(system.matrix, MAT_FINAL_ASSEMBLY);
    MatAssemblyEnd(system.matrix, MAT_FINAL_ASSEMBLY);
}

inline void set_boundary_values(const od::AdaptiveMesh& mesh, const Dofs& dofs,
                                const std::vector<std::uint8_t>& is_fixed, System& system) {
    std::vector<PetscInt> fixed;
    for (const std::size_t v : dofs.own) {
        if (is_fixed[v] == 0) continue;
        fixed.push_back(dofs.number[v]);
        VecSetValue(system.unknown, dofs.number[v], solution(mesh.points()[v]), INSERT_VALUES);
    }
    VecAssemblyBegin(system.unknown);
    VecAssemblyEnd(system.unknown);
    MatZeroRowsColumns(system.matrix, static_cast<PetscInt>(fixed.size()), fixed.data(), 1,
                       system.unknown, system.right);
}

// Returns the value of the vector at each vertex of this process.
inline std::vector<double> at_vertices(const od::AdaptiveMesh& mesh, const Dofs& dofs, Vec vector) {
    std::vector<double> u(mesh.points().size(), 0);
    const PetscScalar* values = nullptr;
    VecGetArrayRead(vector, &values);
    for (std::size_t k = 0; k < dofs.own.size(); ++k) u[dofs.own[k]] = values[k];
    VecRestoreArrayRead(vector, &values);
    od::update_copies(mesh.processes(), mesh.vertex_sharing(), u.size(), std::span(u));
    return u;
}

// ---- estimate -----------------------------------------------------------------------------------

inline std::vector<Vector> gradients_of(const od::AdaptiveMesh& mesh,
                                        const std::vector<double>& u) {
    std::vector<Vector> gradients(mesh.cells().size(), Vector{});
    for (std::size_t c = 0; c < gradients.size(); ++c) {
        const CellGeometry geometry(corners_of(mesh, c));
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t x = 0; x < 3; ++x) {
                gradients[c][x] += u[mesh.cells()[c][i].value()] * geometry.gradients[i][x];
            }
        }
    }
    return gradients;
}

// Returns eta_T^2, computed from jumps of the normal derivative, also across process boundaries.
inline std::vector<double> estimate(const od::AdaptiveMesh& mesh,
                                    const std::vector<Vector>& gradients) {
    const od::FaceNeighbours neighbours = mesh.face_neighbours();
    const od::GhostLayer ghosts = mesh.ghosts(od::GhostsBy::face);
    const std::vector<Vector> ghost_gradients =
        ghosts.values(mesh.processes(), std::span<const Vector>(gradients));
    const auto gradient_of = [&](const od::FaceNeighbour& neighbour) {
        if (neighbour.rank == mesh.processes().rank()) return gradients[neighbour.cell.value()];
        const od::GhostLayer::Owner owner{neighbour.rank, neighbour.cell};
        const auto ghost = std::ranges::lower_bound(ghosts.owners, owner);
        return ghost_gradients[static_cast<std::size_t>(ghost - ghosts.owners.begin())];
    };
    std::vector<double> eta2(mesh.cells().size(), 0);
    for (std::size_t c = 0; c < eta2.size(); ++c) {
        for (std::size_t f = 0; f < 4; ++f) {
            const auto face = face_of(corners_of(mesh, c), f);
            const Vector normal = cross(from_to(face[0], face[1]), from_to(face[0], face[2]));
            const double length = std::sqrt(dot(normal, normal));  // twice the area
            const od::FaceNeighbour& neighbour = neighbours[CellIndex{c}][f];
            double jump = dot(gradients[c], normal) / length;
            if (!neighbour.is_boundary()) {
                jump -= dot(gradient_of(neighbour), normal) / length;
            } else if (!is_natural(face)) {
                continue;
            }
            const double share = neighbour.is_boundary() ? 1 : 0.5;
            eta2[c] += share * std::pow(length / 2, 1.5) * jump * jump;
        }
    }
    return eta2;
}

// ---- measure ------------------------------------------------------------------------------------

class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};
