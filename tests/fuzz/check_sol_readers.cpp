#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/sol_fields.hpp>

#include "files/medit/sol_writer.hpp"
#include "fuzz/check_readers.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::test {
namespace {

namespace fs = std::filesystem;

/// The fields that were read, as those of a mesh without any other content.
class ReadFields final : public MeshSource {
public:
    explicit ReadFields(const SolFields& read) {
        for (const FieldRows& list : read.lists) {
            (list.on == FieldOn::vertices ? facts_.vertices : facts_.cells) = list.count;
            std::size_t at = 0;
            for (const std::size_t components : list.components) {
                fields_.push_back({"f", list.on, FieldType::float64, components});
                auto& values = values_.emplace_back();
                for (std::size_t row = 0; row < list.values.size(); row += list.width()) {
                    for (std::size_t k = 0; k < components; ++k) {
                        values.push_back(
                            list.values[row + at + sol_component_position(k, components)]);
                    }
                }
                at += components;
            }
        }
    }
    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] std::span<const Point> points(const Window&) override { return {}; }
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window&) override { return {}; }
    [[nodiscard]] std::span<const FieldFacts> fields() const override { return fields_; }
    [[nodiscard]] std::span<const std::byte> field_values(std::size_t field,
                                                          const Window& window) override {
        return std::as_bytes(slice(values_[field], window, fields_[field].components));
    }

private:
    MeshFacts facts_;
    std::vector<FieldFacts> fields_;
    std::vector<std::vector<double>> values_;
};

bool same_values(const FieldRows& a, const FieldRows& b) {
    return a.on == b.on && a.components == b.components && a.count == b.count &&
           a.values.size() == b.values.size() &&
           (a.values.empty() ||
            std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(double)) == 0);
}

std::optional<SolFields> read(const fs::path& path) {
    try {
        return read_sol(path, std::nullopt);
    } catch (const InputError& error) {
        check_message(error.what(), path.parent_path());
        return std::nullopt;
    }
}

void check_values(const fs::path& path) {
    const std::optional<SolFields> found = read(path);
    if (!found) return;
    EntityCounts counts;
    for (const FieldRows& list : found->lists) {
        if (list.values.size() != list.count * list.width()) {
            throw BrokenPromise("a list is of another length than what it belongs to");
        }
        (list.on == FieldOn::vertices ? counts.vertices : counts.cells) = list.count;
    }
    const auto together = read_sol_share(path, counts, ProcessGroup::alone());
    if (together && !std::ranges::equal(together->lists, found->lists, same_values)) {
        throw BrokenPromise("shares of a file are not what one process reads");
    }
    ReadFields source(*found);
    for (const std::string extension : {".sol", ".solb"}) {
        const fs::path out = path.parent_path() / ("out" + extension);
        OutputFile file(out);
        write_sol_contents(file, source, extension == ".solb");
        file.commit();
        const std::optional<SolFields> again = read(out);
        std::vector<FieldRows> expected = found->lists;
        std::ranges::sort(expected, {}, &FieldRows::on);
        if (!again || !std::ranges::equal(again->lists, expected, same_values)) {
            throw BrokenPromise("values that are written and read are others");
        }
    }
}

/// The numbers of entities of the mesh in the file, or those of a small mesh if there is none.
EntityCounts counts_of_mesh(const fs::path& path) {
    try {
        const Mesh mesh = read_mesh(path);
        return {mesh.points.size(), mesh.cells.size()};
    } catch (const InputError&) {
        return {5, 2};
    }
}

}  // namespace

void check_sol(std::string_view input, const fs::path& folder) {
    write_file(folder / "in.sol", input);
    check_values(folder / "in.sol");
}

void check_solb(std::string_view input, const fs::path& folder) {
    write_file(folder / "in.solb", input);
    check_values(folder / "in.solb");
}

void check_gmsh_data(std::string_view input, const fs::path& folder) {
    const fs::path path = folder / "in.msh";
    write_file(path, input);
    const EntityCounts counts = counts_of_mesh(path);
    try {
        for (const FieldRows& list : read_msh_data(path, counts).lists) {
            const bool on_vertices = list.on == FieldOn::vertices;
            if (list.count != (on_vertices ? counts.vertices : counts.cells) ||
                list.values.size() != list.count * list.width()) {
                throw BrokenPromise("a list is of another length than what it belongs to");
            }
            if (!std::ranges::all_of(list.values, [](double x) { return std::isfinite(x); })) {
                throw BrokenPromise("a value is not finite");
            }
        }
    } catch (const InputError& error) {
        check_message(error.what(), folder);
    }
}

}  // namespace octetra::test
