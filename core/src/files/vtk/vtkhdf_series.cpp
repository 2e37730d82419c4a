#include <octetra/core/files/series.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/mesh_formats.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "files/hdf5/hdf5_writer.hpp"
#include "files/input/input_file.hpp"
#include "files/output/losses.hpp"
#include "files/output/output_file.hpp"
#include "files/vtk/vtkhdf_arrays.hpp"
#include "files/vtk/vtu.hpp"

namespace octetra {

/// An array of a step in the temporary file.
struct KeptArray {
    std::string name;
    const char* type = "";  ///< VTK's name of the type
    std::size_t value_size = 0;
    std::size_t components = 1;
    std::uint64_t position = 0;
    std::uint64_t rows = 0;

    [[nodiscard]] std::size_t row_size() const { return value_size * components; }
    [[nodiscard]] bool is_like(const KeptArray& other) const {
        return name == other.name && std::string_view(type) == other.type &&
               components == other.components;
    }
};

struct KeptStep {
    double time = 0;
    std::uint64_t points = 0;
    std::uint64_t cells = 0;
    std::vector<KeptArray> arrays;

    [[nodiscard]] const KeptArray* find(const KeptArray& like) const {
        const auto found =
            std::ranges::find_if(arrays, [&](const KeptArray& one) { return one.is_like(like); });
        return found == arrays.end() ? nullptr : &*found;
    }
};

/// The concatenated rows of an array over all steps.
class RowsOfSteps {
public:
    RowsOfSteps(const KeptArray& array, const std::vector<KeptStep>& steps)
        : row_size_(array.row_size()) {
        for (const KeptStep& step : steps) {
            const KeptArray& one = *step.find(array);
            stretches_.push_back({count_, one.rows, one.position});
            count_ += one.rows;
        }
    }

    [[nodiscard]] std::uint64_t count() const { return count_; }

    void read(const InputFile& file, std::uint64_t begin, std::uint64_t end, char* place) const {
        for (const auto& [first, rows, position] : stretches_) {
            const std::uint64_t from = std::max(begin, first);
            const std::uint64_t to = std::min(end, first + rows);
            if (from >= to) continue;
            const std::uint64_t size = (to - from) * row_size_;
            file.read(position + (from - first) * row_size_, place, size);
            place += size;
        }
    }

private:
    struct Stretch {
        std::uint64_t first;
        std::uint64_t rows;
        std::uint64_t position;
    };
    std::size_t row_size_;
    std::uint64_t count_ = 0;
    std::vector<Stretch> stretches_;
};

namespace {

namespace fs = std::filesystem;

FilledDataset numbers(const std::string& name, std::vector<std::int64_t> values,
                      std::vector<std::uint64_t> extents) {
    return {{fmt::format("{}/{}", vtkhdf_root, name), "Int64", std::move(extents)},
            {},
            std::move(values)};
}

/// Returns number(step) for each step.
std::vector<std::int64_t> values_of_steps(const std::vector<KeptStep>& steps, auto&& number) {
    std::vector<std::int64_t> all;
    for (const KeptStep& step : steps) all.push_back(static_cast<std::int64_t>(number(step)));
    return all;
}

/// Returns the exclusive prefix sums of the counts.
std::vector<std::int64_t> begins(const std::vector<std::int64_t>& counts) {
    std::vector<std::int64_t> all;
    std::int64_t sum = 0;
    for (const std::int64_t count : counts) {
        all.push_back(sum);
        sum += count;
    }
    return all;
}

/// Returns the times as integers with the same bits.
std::vector<std::int64_t> bits_of_times(const std::vector<KeptStep>& steps) {
    std::vector<std::int64_t> all;
    for (const KeptStep& step : steps) {
        all.emplace_back();
        std::memcpy(&all.back(), &step.time, sizeof step.time);
    }
    return all;
}

/// Returns the datasets that locate each step for VTK; a step has one part.
std::vector<FilledDataset> datasets_of_steps(const std::vector<KeptStep>& steps,
                                             const std::vector<KeptArray>& arrays) {
    const std::uint64_t n = steps.size();
    const auto points = values_of_steps(steps, [](const KeptStep& step) { return step.points; });
    const auto cells = values_of_steps(steps, [](const KeptStep& step) { return step.cells; });
    const auto connectivity =
        values_of_steps(steps, [](const KeptStep& step) { return 4 * step.cells; });
    std::int64_t part = 0;
    std::vector<FilledDataset> all{
        numbers("NumberOfPoints", points, {n}),
        numbers("NumberOfCells", cells, {n}),
        numbers("NumberOfConnectivityIds", connectivity, {n}),
        numbers("Steps/Values", bits_of_times(steps), {n}),
        numbers("Steps/PartOffsets",
                values_of_steps(steps, [&](const KeptStep&) { return part++; }), {n}),
        numbers("Steps/NumberOfParts", values_of_steps(steps, [](const KeptStep&) { return 1; }),
                {n}),
        numbers("Steps/PointOffsets", begins(points), {n}),
        numbers("Steps/CellOffsets", begins(cells), {n, 1}),
        numbers("Steps/ConnectivityIdOffsets", begins(connectivity), {n, 1})};
    all[3].dataset.type = "Float64";
    for (const KeptArray& array : arrays) {
        const std::size_t slash = array.name.find('/');
        if (slash == std::string::npos) continue;
        const bool of_points = array.name.starts_with("PointData/");
        all.push_back(numbers(
            fmt::format("Steps/{}Offsets{}", array.name.substr(0, slash), array.name.substr(slash)),
            begins(of_points ? points : cells), {n}));
    }
    return all;
}

}  // namespace

struct MeshSeries::Parts {
    fs::path path;
    const ProcessGroup* group;
    OutputFile out;
    std::optional<OutputFile> steps_file;  ///< temporary file with the steps, until commit()
    std::uint64_t end = 0;                 ///< size of the temporary file
    std::vector<KeptStep> steps;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;
    bool has_group_names = false;
    bool has_features = false;

    Parts(const fs::path& name, const ProcessGroup& processes)
        : path(name),
          group(&processes),
          out(name, processes),
          steps_file(std::in_place, name.native() + ".steps", processes) {}

    KeptArray keep(const VtkhdfArray& one) {
        const VtuArray& array = one.array;
        const std::uint64_t values = array.entities * array.values_per_entity;
        KeptArray kept{one.name,         array.type, array.value_size,
                       array.components, end,        values / array.components};
        if (one.begins_with_0) {
            constexpr std::int64_t zero = 0;
            if (group->is_first()) steps_file->overwrite(end, &zero, sizeof zero);
            end += sizeof zero;
            ++kept.rows;
        }
        for_each_slice(array, *group, [&](const Window& window, const std::vector<char>& bytes) {
            const std::uint64_t before = window.begin_of(group->rank()) * array.entity_size();
            steps_file->overwrite(end + before, bytes.data(), bytes.size());
        });
        end += values * array.value_size;
        return kept;
    }

    /// Returns the arrays of the first step that all steps have.
    [[nodiscard]] std::vector<KeptArray> arrays_of_all() const {
        std::vector<KeptArray> arrays = steps.front().arrays;
        std::erase_if(arrays, [&](const KeptArray& array) {
            return std::ranges::any_of(
                steps, [&](const KeptStep& step) { return step.find(array) == nullptr; });
        });
        return arrays;
    }

    /// Returns the dataset of an array over all steps. An error in reading is stored in `failure`,
    /// for a collective agreement later.
    [[nodiscard]] FilledDataset joined(const KeptArray& array, const InputFile* file,
                                       std::string& failure) const {
        const RowsOfSteps rows(array, steps);
        Hdf5Dataset dataset{
            fmt::format("{}/{}", vtkhdf_root, array.name), array.type, {rows.count()}};
        if (array.components > 1) dataset.extents.push_back(array.components);
        VtuArray values{.type = dataset.type,
                        .value_size = array.value_size,
                        .components = array.components,
                        .values_per_entity = array.components,
                        .entities = rows.count()};
        values.bytes_of_slice = [rows, file, size = array.row_size(), rank = group->rank(),
                                 &failure](const Window& window, std::vector<char>& bytes) {
            bytes.assign((window.end_of(rank) - window.begin_of(rank)) * size, 0);
            if (file == nullptr || !failure.empty()) return;
            try {
                rows.read(*file, window.begin_of(rank), window.end_of(rank), bytes.data());
            } catch (const std::exception& error) {
                failure = error.what();
            }
        };
        return {std::move(dataset), std::move(values), {}};
    }

    void put() {
        steps_file->close();
        std::string failure;
        std::optional<InputFile> file;
        try {
            file.emplace(steps_file->temporary());
        } catch (const std::exception& error) {
            failure = error.what();
        }
        const std::vector<KeptArray> arrays = arrays_of_all();
        std::vector<FilledDataset> all = datasets_of_steps(steps, arrays);
        for (const KeptArray& array : arrays) {
            all.push_back(joined(array, file ? &*file : nullptr, failure));
        }
        const std::string in_steps = vtkhdf_root + "/Steps";
        put_hdf5(
            out, path,
            {{vtkhdf_root,
              {{"Version", std::vector<std::int64_t>{2, 0}}, {"Type", "UnstructuredGrid"}}},
             {vtkhdf_root + "/PointData"},
             {vtkhdf_root + "/CellData"},
             {vtkhdf_root + "/FieldData"},
             {in_steps,
              {{"NSteps", std::vector<std::int64_t>{static_cast<std::int64_t>(steps.size())}}}},
             {in_steps + "/PointDataOffsets"},
             {in_steps + "/CellDataOffsets"},
             {in_steps + "/FieldDataOffsets"}},
            all, *group);
        group->agree(failure);
    }

    [[nodiscard]] std::string lost() const {
        std::string lost = lists_left_out(path, facets, edges);
        if (has_group_names) add_loss(lost, group_names_are_lost);
        if (has_features) add_loss(lost, features_are_lost);
        std::vector<std::string> missing;
        for (const KeptStep& step : steps) {
            for (const KeptArray& array : step.arrays) {
                const auto has = [&](const KeptStep& other) {
                    return other.find(array) != nullptr;
                };
                if (std::ranges::all_of(steps, has)) continue;
                const std::string name = array.name.substr(array.name.find('/') + 1);
                if (std::ranges::find(missing, name) == missing.end()) missing.push_back(name);
            }
        }
        for (const std::string& name : missing) {
            add_loss(lost, fmt::format("'{}' is left out of {}: not all steps have it", name,
                                       path.native()));
        }
        return lost;
    }
};

MeshSeries::MeshSeries(const fs::path& path, const ProcessGroup& group) {
    group.on_first([&] {
        if (format_of(path) != Format::vtkhdf) {
            throw InputError(
                fmt::format("{}: a series of meshes is a .vtkhdf file", path.native()));
        }
        check_writable(path);
    });
    parts_ = std::make_unique<Parts>(path, group);
}

MeshSeries::~MeshSeries() = default;

void MeshSeries::append(MeshSource& mesh, double time) {
    const StandardArithmetic standard;
    Parts& parts = *parts_;
    if (!std::isfinite(time) || (!parts.steps.empty() && !(time > parts.steps.back().time))) {
        throw InputError(
            fmt::format("{}: the time of a step must be finite and greater than those "
                        "before, not {}",
                        parts.path.native(), time));
    }
    const MeshFacts& facts = mesh.facts();
    KeptStep step{.time = time, .points = facts.vertices, .cells = facts.cells};
    for (const VtkhdfArray& array : vtkhdf_arrays(mesh)) step.arrays.push_back(parts.keep(array));
    parts.steps.push_back(std::move(step));
    parts.facets = std::max(parts.facets, facts.facets);
    parts.edges = std::max(parts.edges, facts.edges);
    parts.has_group_names = parts.has_group_names || !facts.group_names.empty();
    parts.has_features = parts.has_features || has_any(facts.features);
}

std::string MeshSeries::commit() {
    const StandardArithmetic standard;
    if (parts_->steps.empty()) {
        throw InputError(fmt::format("{}: there is no step to write", parts_->path.native()));
    }
    parts_->put();
    parts_->out.commit();
    parts_->steps_file.reset();
    return parts_->lost();
}

}  // namespace octetra
