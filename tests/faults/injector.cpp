/// To be preloaded (LD_PRELOAD) into a program under mpirun: on rank OCTETRA_FAULT_RANK, call
/// number OCTETRA_FAULT_AT, from 1, of a kind fails. OCTETRA_FAULT_KIND is `file`, for calls that
/// open, write, resize, sync or rename files below OCTETRA_FAULT_FOLDER, which then report a full
/// disk; or `memory`, for allocations by operator new. Calls count after the start of MPI. With 0
/// none fails, and the number of calls is printed on stderr.

#include "support/preloaded.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <mpi.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

namespace {

using octetra::preloaded::is_rank_in_environment;
using octetra::preloaded::number_in_environment;

bool is_in_environment(const char* name, std::string_view value) {
    const char* const text = std::getenv(name);
    return text != nullptr && value == text;
}

/// Counts the calls that may fail, also those of MPI's own threads.
class Injector {
public:
    Injector() = default;
    Injector(const Injector&) = delete;
    Injector& operator=(const Injector&) = delete;
    Injector(Injector&&) = delete;
    Injector& operator=(Injector&&) = delete;
    ~Injector() {
        if (is_this_one_ && fail_at_ == 0) std::fprintf(stderr, "calls: %d\n", calls_.load());
    }

    void mpi_is_started() { is_this_one_ = is_rank_in_environment("OCTETRA_FAULT_RANK"); }
    [[nodiscard]] bool fails() { return is_this_one_ && ++calls_ == fail_at_; }

private:
    std::atomic<bool> is_this_one_{false};
    int fail_at_ = number_in_environment("OCTETRA_FAULT_AT");
    std::atomic<int> calls_{0};
};

Injector injector;
const bool fails_files = is_in_environment("OCTETRA_FAULT_KIND", "file");
const bool fails_memory = is_in_environment("OCTETRA_FAULT_KIND", "memory");

bool is_below_folder(const char* path) {
    const char* const folder = std::getenv("OCTETRA_FAULT_FOLDER");
    return folder != nullptr && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool file_fails(const char* path) {
    return fails_files && is_below_folder(path) && injector.fails();
}

bool file_fails(int file) {
    if (!fails_files) return false;
    std::array<char, 64> link{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
    std::array<char, 4096> path{};
    if (::readlink(link.data(), path.data(), path.size() - 1) <= 0) return false;
    return file_fails(path.data());
}

int disk_is_full() {
    errno = ENOSPC;
    return -1;
}

/// The function that this library wraps.
template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int open_next(const char* name, const char* path, int flags, mode_t mode) {
    if ((flags & O_ACCMODE) != O_RDONLY && file_fails(path)) return disk_is_full();
    return next<int(const char*, int, ...)>(name)(path, flags, mode);
}

void* allocate(std::size_t size, std::size_t alignment) {
    if (fails_memory && injector.fails()) return nullptr;
    if (alignment <= alignof(std::max_align_t)) return std::malloc(size == 0 ? 1 : size);
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
    void* const memory = allocate(size, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list arguments;
    va_start(arguments, flags);
    const auto mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return open_next("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    std::va_list arguments;
    va_start(arguments, flags);
    const auto mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return open_next("open64", path, flags, mode);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
    if (file_fails(file)) return disk_is_full();
    return next<ssize_t(int, const void*, std::size_t)>("write")(file, bytes, size);
}

ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t at) {
    if (file_fails(file)) return disk_is_full();
    return next<ssize_t(int, const void*, std::size_t, off_t)>("pwrite")(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void* bytes, std::size_t size, off64_t at) {
    if (file_fails(file)) return disk_is_full();
    return next<ssize_t(int, const void*, std::size_t, off64_t)>("pwrite64")(file, bytes, size, at);
}

int ftruncate(int file, off_t size) noexcept {
    if (file_fails(file)) return disk_is_full();
    return next<int(int, off_t)>("ftruncate")(file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
    if (file_fails(file)) return disk_is_full();
    return next<int(int, off64_t)>("ftruncate64")(file, size);
}

int fsync(int file) {
    if (file_fails(file)) return disk_is_full();
    return next<int(int)>("fsync")(file);
}

int rename(const char* from, const char* to) noexcept {
    if (file_fails(from)) return disk_is_full();
    return next<int(const char*, const char*)>("rename")(from, to);
}

int MPI_Init(int* argc, char*** argv) {
    const int result = PMPI_Init(argc, argv);
    injector.mpi_is_started();
    return result;
}

int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
    const int result = PMPI_Init_thread(argc, argv, required, provided);
    injector.mpi_is_started();
    return result;
}

}  // extern "C"

void* operator new(std::size_t size) { return allocate_or_throw(size, 1); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
    return allocate(size, 1);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
    return allocate(size, 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*unused*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*unused*/) noexcept {
    std::free(memory);
}
