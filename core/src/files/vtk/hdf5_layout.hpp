#pragma once

#include <cstdint>
#include <string>
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

/// The attributes of the group that VTK looks for.
struct VtkhdfGroup {
    std::string path;
    std::string type;                   ///< attribute Type
    std::vector<std::int64_t> version;  ///< attribute Version
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

/// What HDF5 makes of this group, the groups below it and these datasets. The library writes into
/// memory: so all files are written by one way, and what fails there leaves no file open here. The
/// same arguments give the same bytes, at any time. Memory: some thousand bytes, whatever the
/// extents. Throws SystemError, without a file's name.
[[nodiscard]] Hdf5Skeleton make_hdf5_skeleton(const VtkhdfGroup& group,
                                              const std::vector<std::string>& groups,
                                              const std::vector<Hdf5Dataset>& datasets);

}  // namespace octetra
