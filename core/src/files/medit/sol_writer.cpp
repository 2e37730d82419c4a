#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/files/sol_files.hpp>

#include "files/medit/meshb_heads.hpp"
#include "files/medit/sol_sections.hpp"
#include "files/medit/sol_writer.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

/// A field of a section, and the position of its values in a row.
struct Column {
    std::size_t field = 0;  ///< position in MeshSource::fields()
    FieldFacts facts;
    std::size_t at = 0;
};

/// A section to be written.
struct SectionToWrite {
    std::size_t keyword = 0;
    std::uint64_t count = 0;
    std::vector<Column> columns;
    std::size_t width = 0;
};

std::vector<SectionToWrite> sections_of(const MeshSource& mesh) {
    std::vector<SectionToWrite> sections;
    for (const FieldOn on : {FieldOn::vertices, FieldOn::cells}) {
        SectionToWrite section{
            .keyword = static_cast<std::size_t>(on),
            .count = on == FieldOn::vertices ? mesh.facts().vertices : mesh.facts().cells};
        for (std::size_t f = 0; f < mesh.fields().size(); ++f) {
            const FieldFacts& facts = mesh.fields()[f];
            if (facts.on != on || !sol_can_hold(facts)) continue;
            if (section.columns.size() == max_sol_fields) break;
            section.columns.push_back({f, facts, section.width});
            section.width += facts.components;
        }
        if (!section.columns.empty()) sections.push_back(std::move(section));
    }
    return sections;
}

template <class T>
void put_column(std::span<const std::byte> bytes, const Column& column, std::size_t width,
                std::vector<double>& rows) {
    const std::size_t components = column.facts.components;
    for (std::size_t i = 0; i < bytes.size() / sizeof(T); ++i) {
        T value;
        std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
        const std::size_t place = sol_component_position(i % components, components);
        rows[i / components * width + column.at + place] = static_cast<double>(value);
    }
}

/// Collective. Returns this process's rows of a window.
std::vector<double> rows_of(MeshSource& mesh, const SectionToWrite& section, const Window& window) {
    const int rank = mesh.group().rank();
    std::vector<double> rows((window.end_of(rank) - window.begin_of(rank)) * section.width);
    for (const Column& column : section.columns) {
        const auto bytes = mesh.field_values(column.field, window);
        switch (column.facts.type) {
            case FieldType::float64: put_column<double>(bytes, column, section.width, rows); break;
            case FieldType::float32: put_column<float>(bytes, column, section.width, rows); break;
            case FieldType::int32:
                put_column<std::int32_t>(bytes, column, section.width, rows);
                break;
            case FieldType::int64: break;  // not supported by the format
        }
    }
    return rows;
}

void put_text(OutputFile& out, MeshSource& mesh, const std::vector<SectionToWrite>& sections) {
    const ProcessGroup& group = mesh.group();
    const auto put_first = [&](const std::string& text) {
        if (group.is_first()) out.put(std::string_view(text));
    };
    put_first("MeshVersionFormatted 2\nDimension 3\n");
    for (const SectionToWrite& section : sections) {
        put_first(fmt::format("{}\n{}\n{}", sol_keywords.at(section.keyword).keyword, section.count,
                              section.columns.size()));
        for (const Column& column : section.columns) {
            put_first(fmt::format(" {}", sol_type(column.facts.components)));
        }
        put_first("\n");
        put_list(out, section.count, group, [&](const Window& window, std::uint64_t) {
            const std::vector<double> rows = rows_of(mesh, section, window);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                out.put(rows[i]);
                out.put((i + 1) % section.width == 0 ? '\n' : ' ');
            }
        });
    }
    put_first("End\n");
}

class SolbWriter {
public:
    SolbWriter(OutputFile& out, MeshSource& mesh, const std::vector<SectionToWrite>& sections)
        : out_(&out), mesh_(&mesh), sections_(&sections), head_{mesh, out, version()} {}

    void write() {
        head_.put_start();
        for (const SectionToWrite& section : *sections_) {
            head_.put_section(sol_keywords.at(section.keyword).code, section.count,
                              (1 + section.columns.size()) * sizeof(std::int32_t) +
                                  section.count * section.width * sizeof(double));
            head_.put_first(static_cast<std::int32_t>(section.columns.size()));
            for (const Column& column : section.columns) {
                head_.put_first(sol_type(column.facts.components));
            }
            put_list(*out_, section.count, mesh_->group(),
                     [&](const Window& window, std::uint64_t) {
                         const std::vector<double> rows = rows_of(*mesh_, section, window);
                         out_->put_bytes(rows.data(), rows.size() * sizeof(double));
                     });
        }
        head_.put_end();
    }

private:
    [[nodiscard]] std::int32_t version() const {
        std::uint64_t size = 0;
        std::uint64_t most = 0;
        for (const SectionToWrite& section : *sections_) {
            most = std::max(most, section.count);
            size += section.count * section.width * sizeof(double) + 8 * max_sol_fields;
        }
        return lowest_meshb_version(most, size);
    }

    OutputFile* out_;
    MeshSource* mesh_;
    const std::vector<SectionToWrite>* sections_;
    MeshbHeads head_;
};

}  // namespace

void write_sol_contents(OutputFile& out, MeshSource& mesh, bool is_binary) {
    const std::vector<SectionToWrite> sections = sections_of(mesh);
    if (is_binary) return SolbWriter(out, mesh, sections).write();
    put_text(out, mesh, sections);
}

void commit_with_fields(std::unique_ptr<OutputFile> file, MeshSource& mesh,
                        const std::filesystem::path& path) {
    if (std::ranges::none_of(mesh.fields(), sol_can_hold)) return file->commit();
    const std::filesystem::path beside = *sol_path_for(path);
    std::vector<std::unique_ptr<OutputFile>> files;
    files.push_back(std::move(file));
    files.push_back(std::make_unique<OutputFile>(beside, mesh.group()));
    write_sol_contents(*files.back(), mesh, beside.extension() == ".solb");
    OutputFile::commit_all(files, mesh.group(), [] {});
}

}  // namespace octetra
