#pragma once

#include <string>

namespace octetra::test {

/// During the lifetime of an object, writing to files whose names begin with `beginning` fails as
/// on a full disk, in programs that are linked with full_disk.cpp. At most one may exist.
class FullDisk {
public:
    explicit FullDisk(std::string beginning);
    ~FullDisk();
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    FullDisk(FullDisk&&) = delete;
    FullDisk& operator=(FullDisk&&) = delete;
};

}  // namespace octetra::test
