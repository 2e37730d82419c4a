#include "adapt/check_files.hpp"

#include <vector>

#include "commands/distinct_files.hpp"
#include "commands/mesh_options.hpp"
#include "script/check_script.hpp"

namespace octetra::cli {

void check_files(const AdaptationOptions& options, const Script& script,
                 const distributed::Partition& partition, int ranks) {
    check_output_with_fields(options.input, options.output, ranks);
    std::vector<NamedFiles> read{mesh_named("MESH", options.input.path),
                                 file_named("--fields", options.input.fields),
                                 file_named("--script", script.is_piped ? "" : script.path),
                                 file_named("--partition", partition.path)};
    const std::vector<NamedFiles> lists = files_read_by(script);
    read.insert(read.end(), lists.begin(), lists.end());
    if (!options.series.empty()) check_series(options.series);
    std::vector<NamedFiles> written{file_named("--maps", options.maps),
                                    file_named("--profile", options.profile.profile),
                                    file_named("--trace", options.profile.trace)};
    for (const NamedFiles& beside : written) {
        for (const auto& file : beside.files) check_side_file(beside.argument, file);
    }
    written.push_back(file_named("--series", options.series));
    written.insert(written.begin(), output_to_write("-o", options.input, options.output, ranks));
    check_distinct_files(read, written);
    check_outputs_of(script, options.input, read, written, ranks);
}

}  // namespace octetra::cli
