#include "commands/distinct_files.hpp"

#include <system_error>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/output_paths.hpp>

namespace octetra::cli {
namespace {

namespace fs = std::filesystem;

void check_pair(const NamedFiles& input, const fs::path& read, const NamedFiles& output,
                const fs::path& written) {
    std::error_code not_there;
    if (!fs::equivalent(read, written, not_there)) return;
    const std::string alias =
        read == written ? std::string() : fmt::format(", which is {},", read.native());
    throw InputError(fmt::format("{} would write over {}{} of {}; choose another name",
                                 output.argument, written.native(), alias, input.argument));
}

void check_written_pair(const NamedFiles& one, const NamedFiles& other) {
    for (const fs::path& a : one.files) {
        for (const fs::path& b : other.files) {
            if (refer_to_same_file(a, b)) refuse_same_file(one.argument, a, other.argument, b);
        }
    }
}

}  // namespace

NamedFiles mesh_named(std::string_view argument, const fs::path& path) {
    return {argument, files_of_mesh(path)};
}

NamedFiles mesh_to_write(std::string_view argument, const fs::path& path, int pieces) {
    return {argument, files_to_write(path, pieces)};
}

NamedFiles file_named(std::string_view argument, const fs::path& path) {
    if (path.empty()) return {argument, {}};
    return {argument, {path}};
}

void refuse_same_file(std::string_view one, const fs::path& its_name, std::string_view other,
                      const fs::path& the_others_name) {
    const std::string alias = its_name == the_others_name
                                  ? std::string()
                                  : fmt::format(", which is {}", its_name.native());
    throw InputError(fmt::format("{} and {} name the same file, {}{}", one, other,
                                 the_others_name.native(), alias));
}

void check_distinct_files(const std::vector<NamedFiles>& read,
                          const std::vector<NamedFiles>& written) {
    for (const NamedFiles& output : written) {
        for (const NamedFiles& input : read) {
            for (const fs::path& to : output.files) {
                for (const fs::path& from : input.files) check_pair(input, from, output, to);
            }
        }
    }
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) check_written_pair(written[j], written[i]);
    }
}

}  // namespace octetra::cli
