#include "properties/histories/simpler_steps.hpp"

#include <algorithm>
#include <functional>

#include "properties/histories/rewriting.hpp"

namespace octetra::properties {
namespace {

/// All items but a chunk: chunks are all, halves and so on, down to single items.
template <class T>
std::vector<std::vector<T>> without_chunks(const std::vector<T>& items) {
    std::vector<std::vector<T>> results;
    for (std::size_t length = items.size(); length > 0; length /= 2) {
        for (std::size_t begin = 0; begin < items.size(); begin += length) {
            const std::size_t end = std::min(begin + length, items.size());
            std::vector<T> rest(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(begin));
            rest.insert(rest.end(), items.begin() + static_cast<std::ptrdiff_t>(end), items.end());
            results.push_back(std::move(rest));
        }
    }
    return results;
}

std::vector<Selection> with_fewer_criteria(const Selection& selection) {
    std::vector<Selection> results;
    const auto add = [&](bool changes, const std::function<void(Selection&)>& change) {
        if (!changes) return;
        results.push_back(selection);
        change(results.back());
    };
    add(selection.all, [](Selection& s) { s.all = false; });
    for (const auto& cells : without_chunks(selection.cells)) {
        add(true, [&](Selection& s) { s.cells = cells; });
    }
    add(!selection.spheres.empty(), [](Selection& s) { s.spheres.clear(); });
    add(!selection.boxes.empty(), [](Selection& s) { s.boxes.clear(); });
    add(!selection.regions.empty(), [](Selection& s) { s.regions.clear(); });
    add(selection.random.has_value(), [](Selection& s) { s.random.reset(); });
    add(selection.max_volume.has_value(), [](Selection& s) { s.max_volume.reset(); });
    add(!selection.where.empty(), [](Selection& s) { s.where.clear(); });
    add(!selection.narrowed_by.empty(), [](Selection& s) { s.narrowed_by.clear(); });
    return results;
}

}  // namespace

std::vector<std::vector<Step>> simpler_steps(const std::vector<Step>& steps) {
    auto results = without_chunks(steps);
    const auto with = [&](std::size_t k, const std::function<void(Step&)>& change) {
        results.push_back(steps);
        change(results.back()[k]);
    };
    for (std::size_t k = 0; k < steps.size(); ++k) {
        for (const Selection& selection : with_fewer_criteria(steps[k].selection)) {
            with(k, [&](Step& s) { s.selection = selection; });
        }
        if (steps[k].scheme != Scheme::eight) with(k, [](Step& s) { s.scheme = Scheme::eight; });
        if (steps[k].ranks > 1) with(k, [](Step& s) { s.ranks = 1; });
        if (steps[k].action == Action::rewrite && steps[k].format != simplest_format) {
            with(k, [](Step& s) { s.format = simplest_format; });
        }
    }
    return results;
}

}  // namespace octetra::properties
