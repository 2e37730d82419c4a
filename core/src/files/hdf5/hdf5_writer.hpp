#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <octetra/core/process_group.hpp>

#include "files/hdf5/hdf5_layout.hpp"
#include "files/output/output_file.hpp"
#include "files/output/vtk_arrays.hpp"

namespace octetra {

/// A dataset and its values: an array that is read slice by slice, or a list.
struct FilledDataset {
    Hdf5Dataset dataset;
    VtuArray array;
    std::vector<std::int64_t> values;  ///< written before those of the array
};

/// Collective. Writes an HDF5 file with these groups and datasets; every process writes its slices
/// of the values. `path` is used in the message of a SystemError.
void put_hdf5(OutputFile& out, const std::filesystem::path& path,
              const std::vector<Hdf5Group>& groups, const std::vector<FilledDataset>& all,
              const ProcessGroup& group);

}  // namespace octetra
