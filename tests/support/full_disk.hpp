#pragma once

#include <string>

namespace octetra::test {

/// While one of these lives, writing to files whose names begin with `beginning` fails as on a full
/// disk, for programs that are linked with full_disk.cpp. One at a time.
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
