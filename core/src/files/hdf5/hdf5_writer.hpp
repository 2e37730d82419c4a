#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <octetra/core/process_group.hpp>

#include "files/hdf5/hdf5_layout.hpp"
#include "files/output/output_file.hpp"
#include "files/vtk/vtu_arrays.hpp"

namespace octetra {

/// A dataset, and what is written into it: values that come slice by slice, or are there.
struct FilledDataset {
    Hdf5Dataset dataset;
    VtuArray array;
    std::vector<std::int64_t> values;  ///< these come first
};

/// Collective. Writes an HDF5 file of these groups and datasets, every process its slices of the
/// values. `path` is the file's name in what is thrown, a SystemError.
void put_hdf5(OutputFile& out, const std::filesystem::path& path,
              const std::vector<Hdf5Group>& groups, const std::vector<FilledDataset>& all,
              const ProcessGroup& group);

}  // namespace octetra
