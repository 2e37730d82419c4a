#include "files/hdf5/hdf5_layout.hpp"

#include <hdf5.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {
namespace {

/// Error walk callback: stores the innermost error, as the message of the operating system if there
/// is one.
herr_t note_reason(unsigned, const H5E_error2_t* error, void* reason) {
    constexpr std::string_view in_the_systems_words = "error message = '";
    const std::string_view text = error->desc == nullptr ? "" : error->desc;
    const std::size_t begin = text.find(in_the_systems_words);
    auto& found = *static_cast<std::string*>(reason);
    if (begin == std::string_view::npos) {
        if (found.empty()) found = text;
        return 0;
    }
    const std::string_view words = text.substr(begin + in_the_systems_words.size());
    found = words.substr(0, words.find('\''));
    return 1;  // stop
}

/// Suppresses the printing of errors by HDF5, and restores the program's setting.
class SilencedErrors {
public:
    SilencedErrors() {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~SilencedErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
    SilencedErrors(const SilencedErrors&) = delete;
    SilencedErrors& operator=(const SilencedErrors&) = delete;
    SilencedErrors(SilencedErrors&&) = delete;
    SilencedErrors& operator=(SilencedErrors&&) = delete;

private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

/// An HDF5 identifier, closed by the destructor.
class Handle {
public:
    using Closer = herr_t (*)(hid_t);
    Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
    ~Handle() {
        if (id_ >= 0) closer_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
    Handle& operator=(Handle&&) = delete;

    [[nodiscard]] hid_t id() const { return id_; }
    [[nodiscard]] herr_t close() { return closer_(std::exchange(id_, -1)); }

private:
    hid_t id_;
    Closer closer_;
};

hid_t type_of(std::string_view name) {
    if (name == "Float64") return H5T_IEEE_F64LE;
    if (name == "Float32") return H5T_IEEE_F32LE;
    if (name == "Int64") return H5T_STD_I64LE;
    if (name == "Int32") return H5T_STD_I32LE;
    return H5T_STD_U8LE;
}

std::uint64_t size_of(const Hdf5Dataset& dataset) {
    return std::accumulate(dataset.extents.begin(), dataset.extents.end(),
                           std::uint64_t{H5Tget_size(type_of(dataset.type))}, std::multiplies{});
}

/// An anonymous file in memory. Ranges that were never written take no memory.
class MemoryFile {
public:
    MemoryFile() : file_(::memfd_create("octetra", MFD_CLOEXEC)) {
        if (file_ < 0) throw SystemError(std::strerror(errno));
    }
    ~MemoryFile() { ::close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    MemoryFile(MemoryFile&&) = delete;
    MemoryFile& operator=(MemoryFile&&) = delete;

    [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }
    [[nodiscard]] std::uint64_t size() const {
        struct stat status {};
        if (::fstat(file_, &status) != 0) throw SystemError(std::strerror(errno));
        return static_cast<std::uint64_t>(status.st_size);
    }
    [[nodiscard]] Hdf5Bytes read(std::uint64_t begin, std::uint64_t end) const {
        Hdf5Bytes read{begin, std::vector<char>(end - begin)};
        const ssize_t got =
            ::pread(file_, read.bytes.data(), read.bytes.size(), static_cast<off_t>(begin));
        if (got != static_cast<ssize_t>(read.bytes.size()))
            throw SystemError("reading a file in memory failed");
        return read;
    }

private:
    int file_;
};

class FileMaker {
public:
    explicit FileMaker(std::string path)
        : path_(std::move(path)), file_(create()), creation_(dataset_creation()) {}

    /// Creates a group without timestamps, which would make the bytes of each file different.
    void make_group(const std::string& path) {
        const Handle creation = handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
        check(H5Pset_obj_track_times(creation.id(), false));
        (void)handle(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                     H5Gclose);
    }

    void set_attribute(const std::string& group, const std::string& name, const std::string& text) {
        const Handle type = handle(H5Tcopy(H5T_C_S1), H5Tclose);
        check(H5Tset_size(type.id(), text.size()));
        check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD));
        const Handle space = handle(H5Screate(H5S_SCALAR), H5Sclose);
        write_attribute(group, name, type.id(), type.id(), space, text.data());
    }

    void set_attribute(const std::string& group, const std::string& name,
                       const std::vector<std::int64_t>& numbers) {
        const hsize_t count = numbers.size();
        const Handle space = handle(
            count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
        write_attribute(group, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, numbers.data());
    }

    /// Returns the position of its values in the file.
    std::uint64_t make_dataset(const Hdf5Dataset& dataset) {
        const std::vector<hsize_t> extents(dataset.extents.begin(), dataset.extents.end());
        const Handle space = handle(
            H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
        const Handle made =
            handle(H5Dcreate2(file_.id(), dataset.path.c_str(), type_of(dataset.type), space.id(),
                              H5P_DEFAULT, creation_.id(), H5P_DEFAULT),
                   H5Dclose);
        const haddr_t offset = H5Dget_offset(made.id());
        return offset == HADDR_UNDEF ? 0 : offset;
    }

    /// Completes the skeleton; only now have all its bytes been written.
    void close() { check(file_.close()); }

private:
    Handle create() const {
        const Handle access = handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        // The default driver would resolve the link that this path is, which leads to no file.
        check(H5Pset_fapl_stdio(access.id()));
        return handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    }

    [[nodiscard]] Handle dataset_creation() const {
        Handle creation = handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        check(H5Pset_obj_track_times(creation.id(), false));
        check(H5Pset_layout(creation.id(), H5D_CONTIGUOUS));
        // Allocate the space of the values immediately, but do not write to it.
        check(H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY));
        check(H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER));
        return creation;
    }

    void write_attribute(const std::string& group, const std::string& name, hid_t type,
                         hid_t in_memory, const Handle& space, const void* value) {
        const Handle attribute =
            handle(H5Acreate_by_name(file_.id(), group.c_str(), name.c_str(), type, space.id(),
                                     H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
        check(H5Awrite(attribute.id(), in_memory, value));
    }

    [[nodiscard]] Handle handle(hid_t id, Handle::Closer closer) const {
        check(id);
        return {id, closer};
    }

    void check(std::int64_t outcome) const {
        if (outcome >= 0) return;
        std::string reason;
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_reason, &reason);
        throw SystemError(reason);
    }

    SilencedErrors unprinted_;
    std::string path_;
    Handle file_;
    Handle creation_;
};

/// Throws SystemError if the file would exceed the limit of the process, since HDF5 does not
/// recover from this error.
void check_file_size_limit(const std::vector<Hdf5Dataset>& datasets) {
    constexpr std::uint64_t most_of_the_rest = std::uint64_t{1} << 16U;
    std::uint64_t size = most_of_the_rest;
    for (const Hdf5Dataset& dataset : datasets) size += size_of(dataset);
    struct rlimit limit {};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && size > limit.rlim_cur) {
        throw SystemError(std::strerror(EFBIG));
    }
}

/// Returns the bytes of the file outside the values.
std::vector<Hdf5Bytes> bytes_outside_values(const MemoryFile& file,
                                            const std::vector<std::uint64_t>& values_at,
                                            const std::vector<Hdf5Dataset>& datasets) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> values;
    for (std::size_t k = 0; k < datasets.size(); ++k) {
        const std::uint64_t size = size_of(datasets[k]);
        if (size > 0) values.emplace_back(values_at[k], values_at[k] + size);
    }
    std::ranges::sort(values);
    values.emplace_back(file.size(), file.size());
    std::vector<Hdf5Bytes> rest;
    std::uint64_t at = 0;
    for (const auto& [begin, end] : values) {
        if (begin > at) rest.push_back(file.read(at, begin));
        at = end;
    }
    return rest;
}

}  // namespace

Hdf5Skeleton make_hdf5_skeleton(const std::vector<Hdf5Group>& groups,
                                const std::vector<Hdf5Dataset>& datasets) {
    check_file_size_limit(datasets);
    const MemoryFile file;
    FileMaker maker(file.path());
    for (const Hdf5Group& group : groups) {
        maker.make_group(group.path);
        for (const auto& [name, value] : group.attributes) {
            std::visit([&, &name = name](
                           const auto& held) { maker.set_attribute(group.path, name, held); },
                       value);
        }
    }
    Hdf5Skeleton skeleton;
    for (const Hdf5Dataset& dataset : datasets) {
        skeleton.values_at.push_back(maker.make_dataset(dataset));
    }
    maker.close();
    skeleton.rest = bytes_outside_values(file, skeleton.values_at, datasets);
    return skeleton;
}

}  // namespace octetra
