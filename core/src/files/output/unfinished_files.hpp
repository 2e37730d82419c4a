#pragma once

#include <filesystem>

namespace octetra {

/// Remembers a temporary file while it is being written, for remove_unfinished_files(). A few at a
/// time; those beyond are not remembered, and stay behind if a signal ends the program.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const std::filesystem::path& path);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;
    UnfinishedFile(UnfinishedFile&&) = delete;
    UnfinishedFile& operator=(UnfinishedFile&&) = delete;

private:
    std::size_t slot_;
};

/// While one of these lives, a signal that would end the program waits, as far as
/// remove_unfinished_files() is its handler's way to ask. One at a time.
class DeferredEnd {
public:
    DeferredEnd();
    ~DeferredEnd();
    DeferredEnd(const DeferredEnd&) = delete;
    DeferredEnd& operator=(const DeferredEnd&) = delete;
    DeferredEnd(DeferredEnd&&) = delete;
    DeferredEnd& operator=(DeferredEnd&&) = delete;
};

}  // namespace octetra
