#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

/// The skeleton of an HDF5 file: all its bytes except the values of datasets.
namespace octetra {

/// A dataset stored contiguously.
struct Hdf5Dataset {
    std::string path;  ///< "/GROUP/.../NAME"
    const char* type =
        "";  ///< Float64, Float32, Int64, Int32 or UInt8, as VTK calls them; little-endian
    std::vector<std::uint64_t> extents;
};

/// An attribute: text or integers. A single integer is stored as a scalar.
struct Hdf5Attribute {
    std::string name;
    std::variant<std::string, std::vector<std::int64_t>> value;
};

/// A group. Groups that contain it must precede it.
struct Hdf5Group {
    std::string path;
    std::vector<Hdf5Attribute> attributes = {};
};

/// Bytes of a file and their position.
struct Hdf5Bytes {
    std::uint64_t position = 0;
    std::vector<char> bytes;
};

struct Hdf5Skeleton {
    /// The position of the values of each dataset; 0 for an empty dataset.
    std::vector<std::uint64_t> values_at;
    /// All bytes of the file except the values.
    std::vector<Hdf5Bytes> rest;
};

/// Creates the skeleton of a file with these groups and datasets. HDF5 writes it to a file in
/// memory, so that all output files are written by the same code and an error in HDF5 leaves no
/// open file. The result depends only on the arguments, not on the time. Memory: a few kilobytes,
/// independent of the extents. Throws SystemError without a file name.
[[nodiscard]] Hdf5Skeleton make_hdf5_skeleton(const std::vector<Hdf5Group>& groups,
                                              const std::vector<Hdf5Dataset>& datasets);

}  // namespace octetra
