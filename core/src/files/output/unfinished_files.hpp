#pragma once

#include <filesystem>

namespace octetra {

/// Registers a temporary file for remove_unfinished_files() while it is being written. The number
/// of slots is limited; a file without a slot is not removed if a signal ends the program.
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

/// Defers signals that would end the program, if their handler calls remove_unfinished_files().
/// There may be one object at a time.
class DeferredTermination {
public:
    DeferredTermination();
    ~DeferredTermination();
    DeferredTermination(const DeferredTermination&) = delete;
    DeferredTermination& operator=(const DeferredTermination&) = delete;
    DeferredTermination(DeferredTermination&&) = delete;
    DeferredTermination& operator=(DeferredTermination&&) = delete;
};

}  // namespace octetra
