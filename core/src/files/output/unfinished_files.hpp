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

}  // namespace octetra
