#include "files/output/places.hpp"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/mesh_formats.hpp>

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// Returns the target of the chain of links at `path`; nothing if it is circular.
std::optional<fs::path> end_of_links(fs::path path) {
    constexpr int max_links = 40;  // as many as the system follows
    for (int followed = 0; followed <= max_links; ++followed) {
        std::error_code not_a_link;
        const fs::path next = fs::read_symlink(path, not_a_link);
        if (not_a_link) return path;
        path = path.parent_path() / next;  // equals `next` if that is absolute
    }
    return {};
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool is_tetgen(const fs::path& path) { return format_of(path) == Format::tetgen; }

void add(std::vector<fs::path>& paths, const fs::path& path) {
    if (std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
}

/// Throws InputError if two files of one mesh are the same file through links.
void refuse_one_place_for_two(const std::vector<fs::path>& paths) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!refer_to_same_file(paths[i], paths[j])) continue;
            throw InputError(fmt::format("{} and {} lead to the same file; choose another name",
                                         paths[j].native(), paths[i].native()));
        }
    }
}

std::vector<fs::path> pieces_to_write(const fs::path& path, int pieces) {
    std::vector<fs::path> files{path};
    for (int rank = 0; rank < pieces || fs::exists(piece_path(path, rank)); ++rank) {
        files.push_back(piece_path(path, rank));
    }
    return files;
}

}  // namespace

fs::path resolved_path(const fs::path& path) {
    const fs::path end = end_of_links(path).value_or(path);
    std::error_code no_folder;
    const fs::path folder = fs::weakly_canonical(folder_of(end), no_folder);
    return no_folder ? end : folder / end.filename();
}

bool refer_to_same_file(const fs::path& a, const fs::path& b) {
    return resolved_path(a) == resolved_path(b);
}

std::string write_obstacle(const fs::path& path) {
    if (!end_of_links(path)) return "is a link that refers to itself through other links";
    std::error_code ignored;
    const fs::file_status there = fs::status(path, ignored);
    if (fs::is_directory(there)) return "is a directory, not a file";
    // Renaming a file onto a device, such as /dev/null, would destroy the device.
    if (fs::exists(there) && !fs::is_regular_file(there)) {
        return "is not a regular file";
    }
    if (fs::exists(there) && ::access(path.c_str(), W_OK) != 0) {
        return "is not writable; change its permissions or choose another name";
    }
    return {};
}

void check_output_path(const fs::path& path) {
    if (const std::string what = write_obstacle(path); !what.empty()) {
        throw InputError(fmt::format("{}: {}", path.native(), what));
    }
    const fs::path folder = folder_of(*end_of_links(path));
    if (std::error_code ignored; !fs::is_directory(folder, ignored)) {
        throw InputError(fmt::format("{}: there is no directory {}; create it first", path.native(),
                                     folder.native()));
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        throw InputError(
            fmt::format("{}: the directory {} is not writable", path.native(), folder.native()));
    }
}

fs::path piece_path(const fs::path& path, int rank) {
    return path.parent_path() / fmt::format("{}_{}.vtu", path.stem().native(), rank);
}

fs::path h5_beside(const fs::path& path) { return fs::path(path).replace_extension(".h5"); }

std::vector<fs::path> lists_read_with(const fs::path& path, std::string_view extension) {
    std::vector<fs::path> lists{fs::path(path).replace_extension(extension)};
    for (const char* const of_mesh : {".node", ".ele"}) {
        const fs::path name = fs::path(path).replace_extension(of_mesh);
        if (!fs::is_symlink(name)) continue;
        const fs::path beside = resolved_path(name).replace_extension(extension);
        if (std::ranges::find(lists, beside) == lists.end()) lists.push_back(beside);
    }
    return lists;
}

std::vector<fs::path> files_of_mesh(const fs::path& path) {
    const MeshFormat format = mesh_format_of(path);
    if (format.format == Format::xdmf) return {path, h5_beside(path)};
    if (format.format != Format::tetgen) return {path};
    std::vector<fs::path> files;
    for (const std::string_view extension : format.extensions) {
        files.push_back(fs::path(path).replace_extension(extension));
    }
    return files;
}

std::vector<fs::path> files_to_write(const fs::path& path, int pieces) {
    if (is_in_pieces(path)) return pieces_to_write(path, pieces);
    std::vector<fs::path> files = files_of_mesh(path);
    if (!is_tetgen(path)) return files;
    for (const char* const extension : {".face", ".edge"}) {
        for (const fs::path& list : lists_read_with(path, extension)) add(files, list);
    }
    return files;
}

void check_places(const fs::path& path, int pieces) {
    check_output_path(path);  // first, with the given name
    for (const fs::path& file : files_to_write(path, pieces)) check_output_path(file);
    refuse_one_place_for_two(is_in_pieces(path) ? pieces_to_write(path, pieces)
                                                : files_of_mesh(path));
}

}  // namespace octetra
