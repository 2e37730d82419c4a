#include "commands/selection_options.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/check_selection.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/select_cells.hpp>

#include "commands/abbreviations.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "commands/size_option.hpp"
#include "parse_numbers.hpp"

namespace octetra::cli {
namespace {

Sphere parse_sphere(const std::string& text) {
    const auto n = parse_reals(text, 4, "--sphere", "X,Y,Z,R");
    const Sphere sphere{{n[0], n[1], n[2]}, n[3]};
    check(sphere, "--sphere", text);
    return sphere;
}

Box parse_box(const std::string& text) {
    const auto n = parse_reals(text, 6, "--box", "X0,Y0,Z0,X1,Y1,Z1");
    const Box box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    check(box, "--box", text);
    return box;
}

Expression parse_where(const std::string& text) {
    try {
        return Expression(text);
    } catch (const InputError& error) {
        throw InputError(fmt::format("--where: {}", error.what()));
    }
}

Marker parse_tag(const std::string& text) {
    using Limits = std::numeric_limits<Marker>;
    const std::string words = fmt::format("{} to {}", Limits::min(), Limits::max());
    return parse_number<Marker>("--region", text, {Limits::min(), Limits::max(), words});
}

/// Returns whether the text is a tag rather than a group name.
bool is_tag(const std::string& text) {
    return text.empty() || text.find_first_of("0123456789+- ") == 0;
}

/// Returns the tags of all groups of cells with this name.
std::vector<Marker> tags_of(const std::string& name, const std::vector<GroupName>& groups) {
    std::vector<Marker> tags;
    std::string known;
    for (const GroupName& group : groups) {
        if (group.dimension != 3) continue;
        if (group.name == name) tags.push_back(group.tag);
        known += (known.empty() ? "" : ", ") + group.name;
    }
    if (!tags.empty()) return tags;
    if (known.empty()) {
        throw InputError(fmt::format(
            "--region: no group of cells of this mesh has a name, and '{}' is no tag", name));
    }
    throw InputError(
        fmt::format("--region: no group of cells is called '{}'; there are {}", name, known));
}

/// Collective, within a transaction. Returns the tags that any process passes.
std::set<Marker> tags_of_all(std::span<const Marker> of_cells, const ProcessGroup& processes) {
    const std::set<Marker> own(of_cells.begin(), of_cells.end());
    const std::vector<Marker> list(own.begin(), own.end());
    const auto bytes = std::as_bytes(std::span(list));
    std::set<Marker> tags;
    for (const ProcessGroup::Bytes& other : processes.of_all({bytes.begin(), bytes.end()})) {
        std::vector<Marker> received(other.size() / sizeof(Marker));
        std::memcpy(received.data(), other.data(), other.size());
        tags.insert(received.begin(), received.end());
    }
    return tags;
}

}  // namespace

void add_selection_options(CLI::App& subcommand, SelectionOptions& options,
                           const std::string& group) {
    subcommand.add_flag("--all", options.all, "all cells")->group(group);
    subcommand
        .add_option("--cells", options.cells_file,
                    "cells listed in a file, with the numbers of MESH")
        ->type_name("FILE")
        ->check(file_name_validator())
        ->group(group);
    subcommand
        .add_option("--sphere", options.spheres, "cells with their centroid closer than R to X,Y,Z")
        ->type_name("X,Y,Z,R")
        ->allow_extra_args(false)
        ->group(group);
    subcommand.add_option("--box", options.boxes, "cells with their centroid in the box")
        ->type_name("X0,Y0,Z0,X1,Y1,Z1")
        ->allow_extra_args(false)
        ->group(group);
    subcommand
        .add_option("--region", options.regions,
                    "cells with this region tag, or in groups with this name (.msh, .octetra)")
        ->type_name("TAG")
        ->allow_extra_args(false)
        ->group(group);
    add_number<double>(subcommand, "--random", options.random, {0, 1, "0 to 1"},
                       "about this fraction of the cells")
        ->type_name("FRACTION")
        ->group(group);
    add_number(subcommand, "--seed", options.seed, whole_numbers_from(0), "for --random [0]")
        ->type_name("N")
        ->group(group);
    add_number<double>(subcommand, "--max-volume", options.max_volume,
                       {std::numeric_limits<double>::denorm_min(),
                        std::numeric_limits<double>::max(), "above 0", ""},
                       "cells with a larger volume")
        ->type_name("V")
        ->group(group);
    subcommand
        .add_option("--where", options.where,
                    "cells for which an expression is true, such as \"longest > 0.02 and x < 1\";\n"
                    "docs/cli.md lists its variables and functions")
        ->type_name("EXPRESSION")
        ->allow_extra_args(false)
        ->group(group);
    add_size_option(subcommand, options, group, "cells with an edge longer than this size");
    for (const Abbreviation& abbreviation : abbreviations()) {
        const std::string name(abbreviation.option);
        subcommand
            .add_option("--" + name, options.abbreviated[name],
                        std::string(abbreviation.description))
            ->type_name(std::string(abbreviation.type))
            ->allow_extra_args(false)
            ->group(group);
    }
    subcommand
        .add_flag_function(
            "--and", [](std::int64_t) {},
            "of the cells that the criteria before it mark, only those that one of the\n"
            "criteria after it marks, too")
        ->group(group);
}

void group_criteria(const CLI::App& subcommand, SelectionOptions& options) {
    if (options.gradation && options.sizes.empty()) {
        throw InputError("--gradation requires --size, as in --size 0.05 --gradation 1.3");
    }
    std::vector<SelectionOptions> groups(1);
    const auto next_of = [](std::vector<std::string>& from) {
        std::string text = std::move(from.front());
        from.erase(from.begin());
        return text;
    };
    const auto take_next = [&](std::vector<std::string>& to, std::vector<std::string>& from) {
        to.push_back(next_of(from));
    };
    for (const CLI::Option* option : subcommand.parse_order()) {
        const std::vector<std::string>& names = option->get_lnames();
        const std::string name = names.empty() ? "" : names.front();
        SelectionOptions& group = groups.back();
        if (name == "and") groups.emplace_back();
        if (name == "all") group.all = options.all;
        if (name == "cells") group.cells_file = options.cells_file;
        if (name == "sphere") take_next(group.spheres, options.spheres);
        if (name == "box") take_next(group.boxes, options.boxes);
        if (name == "region") take_next(group.regions, options.regions);
        if (name == "random") group.random = options.random;
        if (name == "seed") group.seed = options.seed;
        if (name == "max-volume") group.max_volume = options.max_volume;
        if (name == "where") take_next(group.where, options.where);
        if (name == "size") {
            take_next(group.sizes, options.sizes);
            group.where.push_back(
                fmt::format("longest > ({})", target_size(group.sizes.back(), options.gradation)));
        }
        for (const Abbreviation& abbreviation : abbreviations()) {
            if (name != abbreviation.option) continue;
            group.where.push_back(abbreviation.expression(next_of(options.abbreviated[name])));
        }
    }
    if (groups.size() > 1) {
        if (!std::ranges::all_of(groups, has_criterion)) {
            throw InputError("--and requires a criterion before and after it");
        }
        if (!options.cells_file.empty()) throw InputError("--cells cannot be combined with --and");
    }
    options = std::move(groups.front());
    options.narrowed_by.assign(std::make_move_iterator(groups.begin() + 1),
                               std::make_move_iterator(groups.end()));
}

bool has_criterion(const SelectionOptions& options) {
    return options.all || !options.cells_file.empty() || !options.spheres.empty() ||
           !options.boxes.empty() || !options.regions.empty() || options.random ||
           options.max_volume || !options.where.empty();
}

Selection parse_selection(const SelectionOptions& options, std::string_view wanted) {
    Selection selection;
    selection.all = options.all;
    for (const std::string& text : options.spheres) selection.spheres.push_back(parse_sphere(text));
    for (const std::string& text : options.boxes) selection.boxes.push_back(parse_box(text));
    for (const std::string& text : options.regions) {
        if (is_tag(text)) selection.regions.push_back(parse_tag(text));
    }
    if (options.random) {
        selection.random = RandomShare{*options.random, options.seed.value_or(0)};
        check(*selection.random, "--random");
    }
    if (options.seed && !options.random) {
        throw InputError("--seed requires --random, as in --random 0.1 --seed 7");
    }
    selection.max_volume = options.max_volume;
    for (const std::string& text : options.where) selection.where.push_back(parse_where(text));
    if (!has_criterion(options)) {
        std::string names =
            "--all, --cells, --sphere, --box, --region, --random, --max-volume, --size";
        for (const Abbreviation& other : abbreviations())
            names += fmt::format(", --{}", other.option);
        throw InputError(fmt::format("specify {}: {} or --where", wanted, names));
    }
    for (const SelectionOptions& other : options.narrowed_by) {
        selection.narrowed_by.push_back(parse_selection(other, wanted));
    }
    return selection;
}

bool can_verify(const Selection& selection) { return external_terms(selection).empty(); }

void check_verifiable(const Selection& selection) {
    const std::vector<Term> terms = external_terms(selection);
    if (terms.empty()) return;
    throw InputError(
        fmt::format("--where: the verifier knows only the corners and the region tag of each cell, "
                    "and cannot evaluate {}",
                    text_of(terms.front())));
}

void check_regions(const SelectionOptions& options, std::span<const Marker> of_cells,
                   const ProcessGroup& processes) {
    for (const SelectionOptions& other : options.narrowed_by) {
        check_regions(other, of_cells, processes);
    }
    if (std::ranges::none_of(options.regions, is_tag)) return;
    const auto tags = processes.transaction([&] { return tags_of_all(of_cells, processes); });
    if (tags.empty()) throw InputError("--region: the cells of this mesh have no region tags");
    for (const std::string& text : options.regions) {
        if (!is_tag(text) || tags.contains(parse_tag(text))) continue;
        constexpr std::ptrdiff_t shown = 20;
        const bool has_more = std::ssize(tags) > shown;
        const auto end = has_more ? std::next(tags.begin(), shown) : tags.end();
        throw InputError(fmt::format("--region: no cell has region tag {}; there are {}{}", text,
                                     fmt::join(tags.begin(), end, ", "), has_more ? ", ..." : ""));
    }
}

void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh) {
    selection.regions.clear();
    for (const std::string& text : options.regions) {
        if (is_tag(text)) {
            selection.regions.push_back(parse_tag(text));
        } else {
            const auto tags = tags_of(text, mesh.group_names.list());
            selection.regions.insert(selection.regions.end(), tags.begin(), tags.end());
        }
    }
    if (!options.cells_file.empty()) {
        selection.cells = read_cell_list(options.cells_file, mesh.index_base, mesh.cells);
    }
    for (std::size_t k = 0; k < options.narrowed_by.size(); ++k) {
        complete_selection(selection.narrowed_by[k], options.narrowed_by[k], mesh);
    }
}

void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh, const distributed::Communicator& processes) {
    processes.on_first([&] { complete_selection(selection, options, mesh); });
    processes.broadcast(selection.cells);
    processes.broadcast(selection.regions);
    for (Selection& other : selection.narrowed_by) processes.broadcast(other.regions);
}

}  // namespace octetra::cli
