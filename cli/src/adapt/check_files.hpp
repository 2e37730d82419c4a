#pragma once

#include <octetra/distributed/partition.hpp>

#include "adapt/adaptation.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// Throws InputError for outputs that cannot be written, or that would overwrite an input or each
/// other.
void check_files(const AdaptationOptions& options, const Script& script,
                 const distributed::Partition& partition, int ranks);

}  // namespace octetra::cli
