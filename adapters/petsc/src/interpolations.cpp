#include <octetra/petsc/interpolations.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "check_petsc.hpp"

namespace octetra::petsc {
namespace {

using distributed::Levels;
using distributed::SparseRows;

/// Owns matrices under construction, and destroys them unless they are completed.
class NewMatrices {
public:
    NewMatrices() = default;
    ~NewMatrices() {
        for (Mat& matrix : matrices_) (void)MatDestroy(&matrix);
    }
    NewMatrices(const NewMatrices&) = delete;
    NewMatrices& operator=(const NewMatrices&) = delete;
    NewMatrices(NewMatrices&&) = delete;
    NewMatrices& operator=(NewMatrices&&) = delete;

    [[nodiscard]] Mat& add() { return matrices_.emplace_back(nullptr); }
    [[nodiscard]] std::vector<Mat> release() { return std::exchange(matrices_, {}); }

private:
    std::vector<Mat> matrices_;
};

PetscInt owned_count(const Levels& levels, std::size_t level) {
    PetscInt count = 0;
    for (VertexIndex v{0}; v < VertexIndex{levels.points(level).size()}; ++v) {
        if (levels.vertex_sharing(level).is_owned(v)) ++count;
    }
    return count;
}

void check_range(std::uint64_t count, const char* what) {
    if (count <= static_cast<std::uint64_t>(std::numeric_limits<PetscInt>::max())) return;
    throw InputError(fmt::format("{} {} are too many for PETSc's integers", count, what));
}

/// The rows with integers of PETSc.
struct PetscRows {
    std::vector<PetscInt> begin;
    std::vector<PetscInt> columns;
    std::vector<PetscScalar> values;

    explicit PetscRows(const SparseRows& rows)
        : begin(rows.row_begin.begin(), rows.row_begin.end()),
          columns(rows.columns.begin(), rows.columns.end()),
          values(rows.values.begin(), rows.values.end()) {}
};

void create(MPI_Comm comm, PetscInt own_rows, PetscInt own_columns, Mat& matrix) {
    check(MatCreate(comm, &matrix));
    check(MatSetSizes(matrix, own_rows, own_columns, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(matrix, MATAIJ));
}

/// Each of the two calls does nothing for matrices of the other type.
void fill(Mat matrix, const PetscRows& rows) {
    const PetscInt* const begin = rows.begin.data();
    check(MatSeqAIJSetPreallocationCSR(matrix, begin, rows.columns.data(), rows.values.data()));
    check(MatMPIAIJSetPreallocationCSR(matrix, begin, rows.columns.data(), rows.values.data()));
}

}  // namespace

std::vector<Mat> interpolations(const Levels& levels, MPI_Comm comm) {
    const auto& processes = levels.processes();
    processes.transaction([&] { check_group(processes, comm); });
    const SilentErrors silent;
    NewMatrices matrices;
    for (std::size_t k = 0; k + 1 < levels.count(); ++k) {
        processes.transaction([&] {
            check_range(levels.vertex_count(k + 1), "vertices");
            const SparseRows rows = levels.prolongation(k);
            check_range(rows.columns.size(), "entries");
            const PetscRows converted(rows);
            Mat& matrix = matrices.add();
            processes.agree_on_success();
            create(comm, owned_count(levels, k + 1), owned_count(levels, k), matrix);
            fill(matrix, converted);
        });
    }
    return matrices.release();
}

}  // namespace octetra::petsc
