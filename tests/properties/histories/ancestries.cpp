#include "properties/histories/ancestries.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

namespace octetra::properties {

using distributed::Adaptation;
using distributed::AdaptiveMesh;
using distributed::Field;

namespace {

/// More than any history refines.
constexpr std::size_t most_generations = 16;

/// Only the first fault is kept.
void note(std::string* fault, const char* words) {
    if (fault->empty()) *fault = words;
}

/// The halvings of the regular cells around a cell with this number of halvings.
std::vector<int> of_generations(int total) {
    std::vector<int> halvings;
    for (int each = 0; each < total; each += 3) halvings.push_back(each);
    return halvings;
}

/// The past of the cell that results when merging undoes the last `halvings` halvings.
Ancestry undo_halvings(const Ancestry& past, int halvings, std::string* fault) {
    if (halvings == 0) return past;
    const int left = past.halvings.back() - halvings;
    Ancestry back = past;
    back.halvings.pop_back();
    if (back.halvings.empty() || left < back.halvings.back()) {
        note(fault, "a cell is back by more than one generation");
        return past;
    }
    if (left > back.halvings.back()) back.halvings.push_back(left);
    return back;
}

}  // namespace

Ancestries initial_ancestries(const AdaptiveMesh& mesh, const std::vector<CellVertices>& input) {
    using Corners = std::array<std::uint64_t, 4>;
    std::map<Corners, std::uint64_t> roots;
    for (std::size_t c = 0; c < input.size(); ++c) {
        Corners corners{};
        for (std::size_t k = 0; k < 4; ++k) corners[k] = input[c][k].value();
        roots[corners] = c;
    }
    Ancestries ancestries;
    for (const CellVertices& cell : mesh.cells()) {
        Corners corners{};
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = static_cast<std::uint64_t>(mesh.vertex_numbers()[cell[k].value()]);
        }
        ancestries.push_back({.root = roots.at(corners)});
    }
    return ancestries;
}

Ancestries refined(const Ancestries& ancestries, const Adaptation& step, Closure closure) {
    Ancestries after = ancestries;
    after.resize(step.cells.count());
    step.cells.for_each_new([&](std::size_t number, std::size_t before, unsigned halvings) {
        after[number] = ancestries[before];
        if (halvings == 0) return;
        std::vector<int>& of_cell = after[number].halvings;
        const int total = of_cell.back() + static_cast<int>(halvings);
        if (closure == Closure::regular) of_cell = of_generations(total);
        of_cell.push_back(total);
    });
    return after;
}

Ancestries coarsened(const Ancestries& ancestries, const Adaptation& step,
                     std::span<const std::uint8_t> may_coarsen, std::string* fault) {
    if (!step.changed) return ancestries;
    Ancestries after(step.cells.count());
    std::vector<double> filled(after.size(), 0);
    for (std::size_t c = 0; c < ancestries.size(); ++c) {
        const std::uint32_t whole = step.cells.coarse_of()[c];
        const int halvings = step.cells.halvings()[c];
        if (may_coarsen[c] == 0 && halvings != 0) note(fault, "a cell that was not marked is gone");
        const Ancestry past = undo_halvings(ancestries[c], halvings, fault);
        if (filled[whole] > 0 && after[whole] != past)
            note(fault, "a cell is merged from unrelated cells");
        after[whole] = past;
        filled[whole] += std::ldexp(1.0, -halvings);
    }
    for (const double share : filled) {
        if (share != 1) note(fault, "the children of a cell do not fill it");
    }
    return after;
}

Ancestries moved(const Ancestries& ancestries, const distributed::Migration& move) {
    std::vector<std::uint64_t> roots;
    distributed::ValueLists<int> halvings;
    for (const Ancestry& past : ancestries) {
        roots.push_back(past.root);
        halvings.values.insert(halvings.values.end(), past.halvings.begin(), past.halvings.end());
        halvings.begin.push_back(halvings.values.size());
    }
    roots = move.cells(std::move(roots));
    halvings = move.cells(std::move(halvings));
    Ancestries after;
    for (std::size_t c = 0; c < roots.size(); ++c) {
        const auto at = [&](std::uint64_t place) {
            return halvings.values.begin() + static_cast<std::ptrdiff_t>(place);
        };
        after.push_back(
            {.root = roots[c], .halvings = {at(halvings.begin[c]), at(halvings.begin[c + 1])}});
    }
    return after;
}

std::vector<Field> fields_of(const Ancestries& ancestries) {
    std::vector<std::int64_t> roots;
    std::vector<std::int32_t> halvings;
    for (const Ancestry& past : ancestries) {
        if (past.halvings.size() > most_generations) throw std::logic_error("too many generations");
        roots.push_back(static_cast<std::int64_t>(past.root));
        halvings.insert(halvings.end(), past.halvings.begin(), past.halvings.end());
        halvings.resize(most_generations * roots.size(), -1);
    }
    return {{"root", FieldOn::cells, 1, std::move(roots)},
            {"halvings", FieldOn::cells, most_generations, std::move(halvings)}};
}

Ancestries ancestries_of(const std::vector<Field>& fields) {
    const auto& roots = std::get<std::vector<std::int64_t>>(fields.at(0).values);
    const auto& halvings = std::get<std::vector<std::int32_t>>(fields.at(1).values);
    Ancestries ancestries;
    for (std::size_t c = 0; c < roots.size(); ++c) {
        Ancestry past{.root = static_cast<std::uint64_t>(roots[c]), .halvings = {}};
        for (std::size_t k = 0; k < most_generations; ++k) {
            const int each = halvings[c * most_generations + k];
            if (each >= 0) past.halvings.push_back(each);
        }
        ancestries.push_back(std::move(past));
    }
    return ancestries;
}

}  // namespace octetra::properties
