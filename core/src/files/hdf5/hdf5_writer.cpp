#include "files/hdf5/hdf5_writer.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Collective. Writes the values of a dataset.
void put_values(OutputFile& out, const FilledDataset& filled, std::uint64_t offset,
                const ProcessGroup& group) {
    const std::size_t head = filled.values.size() * sizeof(std::int64_t);
    if (group.is_first() && head > 0) out.overwrite(offset, filled.values.data(), head);
    const VtuArray& array = filled.array;
    if (array.entities == 0) return;
    for_each_slice(array, group, [&](const Window& window, const std::vector<char>& bytes) {
        const std::uint64_t before = window.begin_of(group.rank()) * array.entity_size();
        out.overwrite(offset + head + before, bytes.data(), bytes.size());
    });
}

/// Collective. The first process writes the skeleton; returns the position of each dataset's values
/// on all processes.
std::vector<std::uint64_t> put_skeleton(OutputFile& out, const std::filesystem::path& path,
                                        const std::vector<Hdf5Group>& groups,
                                        const std::vector<FilledDataset>& all,
                                        const ProcessGroup& group) {
    std::vector<std::uint64_t> values_at(all.size());
    group.on_first([&] {
        std::vector<Hdf5Dataset> datasets;
        for (const FilledDataset& filled : all) datasets.push_back(filled.dataset);
        Hdf5Skeleton skeleton;
        try {
            skeleton = make_hdf5_skeleton(groups, datasets);
        } catch (const SystemError& error) {
            throw SystemError(fmt::format("{}: writing failed: {}", path.native(), error.what()));
        }
        values_at = std::move(skeleton.values_at);
        for (const auto& [position, bytes] : skeleton.rest) {
            out.overwrite(position, bytes.data(), bytes.size());
        }
    });
    for (std::uint64_t& position : values_at) position = group.of_first(position);
    return values_at;
}

}  // namespace

void put_hdf5(OutputFile& out, const std::filesystem::path& path,
              const std::vector<Hdf5Group>& groups, const std::vector<FilledDataset>& all,
              const ProcessGroup& group) {
    const std::vector<std::uint64_t> values_at = put_skeleton(out, path, groups, all, group);
    for (std::size_t k = 0; k < all.size(); ++k) put_values(out, all[k], values_at[k], group);
}

}  // namespace octetra
