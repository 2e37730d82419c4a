#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

/// The skeleton of an HDF5 file: everything but the values.
namespace octetra {

/// A dataset that is stored as one stretch of bytes.
struct Hdf5Dataset {
    std::string path;  ///< "/GROUP/.../NAME"
    const char* type =
        "";  ///< Float64, Float32, Int64, Int32 or UInt8, as VTK calls them; little-endian
    std::vector<std::uint64_t> extents;
};

/// An attribute: text, or whole numbers, of which one alone is no list.
struct Hdf5Attribute {
    std::string name;
    std::variant<std::string, std::vector<std::int64_t>> value;
};

/// A group; those that it is in stand before it.
struct Hdf5Group {
    std::string path;
    std::vector<Hdf5Attribute> attributes = {};
};

/// Bytes of a file, and where they stand.
struct Hdf5Bytes {
    std::uint64_t position = 0;
    std::vector<char> bytes;
};

struct Hdf5Skeleton {
    /// Where the values of each dataset belong; 0 for one that has none.
    std::vector<std::uint64_t> values_at;
    /// All of the file but the values.
    std::vector<Hdf5Bytes> rest;
};

/// What HDF5 makes of these groups and datasets. The library writes into
/// memory: so all files are written by one way, and what fails there leaves no file open here. The
/// same arguments give the same bytes, at any time. Memory: some thousand bytes, whatever the
/// extents. Throws SystemError, without a file's name.
[[nodiscard]] Hdf5Skeleton make_hdf5_skeleton(const std::vector<Hdf5Group>& groups,
                                              const std::vector<Hdf5Dataset>& datasets);

}  // namespace octetra
