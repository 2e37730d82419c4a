#pragma once

#include <octetra/distributed/partition.hpp>

#include "adapt/adaptation.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// Refuses outputs that cannot be written, or would take the place of an input or of each other.
/// Throws InputError.
void check_files(const AdaptationOptions& options, const Script& script,
                 const distributed::Partition& partition, int ranks);

}  // namespace octetra::cli
