#include "script/check_script.hpp"

#include <limits>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/output_paths.hpp>

#include "commands/mesh_options.hpp"
#include "commands/size_option.hpp"

namespace octetra::cli {
namespace {

/// Calls check(step) for each step; prepends the line to errors.
void check_each(const Script& script, auto&& check) {
    for (const ScriptStep& step : script.steps) {
        try {
            check(step);
        } catch (const InputError& error) {
            throw wrong_line(script, step, error.what() + hint_of_comment(script.path, step.line));
        }
    }
}

/// The output files so far, by their final paths. Avoids a quadratic number of comparisons for long
/// scripts.
class OutputPaths {
public:
    struct Name {
        std::string argument;
        std::filesystem::path path;
    };

    void add(const std::string& argument, const std::vector<std::filesystem::path>& files) {
        for (const auto& file : files)
            places_.try_emplace(resolved_path(file), Name{argument, file});
    }
    /// Returns the argument that already writes this file, or null.
    [[nodiscard]] const Name* find(const std::filesystem::path& file) const {
        const auto found = places_.find(resolved_path(file));
        return found == places_.end() ? nullptr : &found->second;
    }

private:
    std::map<std::filesystem::path, Name> places_;
};

}  // namespace

const SelectionOptions* criteria_of(const Step& step) {
    if (const auto* refine = std::get_if<RefineStep>(&step)) {
        return &refine->typed.selection;
    }
    if (const auto* coarsen = std::get_if<CoarsenStep>(&step)) return &coarsen->typed.selection;
    if (const auto* fit = std::get_if<FitStep>(&step)) return &fit->typed.selection;
    return nullptr;
}

std::vector<NamedFiles> files_read_by(const Script& script) {
    std::vector<NamedFiles> files;
    for (const ScriptStep& step : script.steps) {
        const SelectionOptions* criteria = criteria_of(step.step);
        if (criteria == nullptr) continue;
        if (!criteria->cells_file.empty()) {
            files.push_back(file_named("--cells", criteria->cells_file));
        }
        for (const std::string& file : size_files_of(*criteria)) {
            files.push_back(is_background_file(file) ? mesh_named("--size", file)
                                                     : file_named("--size", file));
        }
    }
    return files;
}

void check_outputs_of(const Script& script, const InputOptions& input,
                      const std::vector<NamedFiles>& read, const std::vector<NamedFiles>& written,
                      int ranks) {
    OutputPaths places;
    for (const NamedFiles& files : written) places.add(std::string(files.argument), files.files);
    check_each(script, [&](const ScriptStep& step) {
        const auto* write = std::get_if<WriteStep>(&step.step);
        if (write == nullptr) return;
        check_output_with_fields(input, write->path, ranks);
        const NamedFiles files = output_to_write(step.word, input, write->path, ranks);
        check_distinct_files(read, {files});
        for (const auto& file : files.files) {
            if (const auto* other = places.find(file)) {
                refuse_same_file(other->argument, other->path, step.word, file);
            }
        }
        places.add(fmt::format("line {}", step.line), files.files);
    });
}

void check_lists_of(const Script& script) {
    constexpr auto unlimited = std::numeric_limits<std::size_t>::max();
    check_each(script, [&](const ScriptStep& step) {
        const SelectionOptions* criteria = criteria_of(step.step);
        if (criteria == nullptr || criteria->cells_file.empty()) return;
        (void)read_cell_list(criteria->cells_file, 0, unlimited);
    });
}

void check_regions_of(const Script& script, std::span<const Marker> of_cells,
                      const ProcessGroup& processes) {
    check_each(script, [&](const ScriptStep& step) {
        const SelectionOptions* criteria = criteria_of(step.step);
        if (criteria != nullptr) check_regions(*criteria, of_cells, processes);
    });
}

}  // namespace octetra::cli
