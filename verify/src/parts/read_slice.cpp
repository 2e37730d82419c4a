#include <optional>
#include <string>

#include <octetra/core/error.hpp>
#include <octetra/core/files.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "parts/exchange.hpp"

namespace octetra::verify {
namespace {

/// Collective. Throws on all processes what the first one has met, if anything.
void agree(const std::optional<std::string>& input_error, const std::optional<std::string>& failure,
           const Group& group) {
    const auto of_first = [&](const std::optional<std::string>& what) {
        std::vector<char> text;
        if (what) text.assign(what->begin(), what->end());
        if (what) text.push_back('.');  // told from nothing even if empty
        text = share_with_all(group, text).front();
        return text.empty() ? std::nullopt
                            : std::optional(std::string(text.begin(), text.end() - 1));
    };
    if (const auto what = of_first(input_error)) throw InputError(*what);
    if (const auto what = of_first(failure)) throw SystemError(*what);
}

}  // namespace

MeshSlice read_slice(const std::filesystem::path& path, const ReadOptions& options,
                     const Group& group) {
    Mesh mesh;
    std::optional<std::string> input_error;
    std::optional<std::string> failure;
    try {
        if (group.is_first()) mesh = read_mesh(path, options);
    } catch (const InputError& error) {
        input_error = error.what();
    } catch (const std::exception& error) {
        failure = error.what();
    }
    agree(input_error, failure, group);
    return share_out(mesh, group);
}

}  // namespace octetra::verify
