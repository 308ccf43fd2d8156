// What is asked of a run, held against its script and the disk before the first step.
#pragma once

#include "run/commands/run.h"

#include <span>

namespace cascade {

/// What `request` writes to, before defaults are known: the picture of a script goes to SCRIPT.png.
std::vector<std::filesystem::path> outputs_of(const Script& script, const RunRequest& request);

/// Where the log goes: beside the first output, unless it is said.
std::filesystem::path log_path(const RunRequest& request,
                               const std::filesystem::path& first_output);

/// The pictures of a turntable: NAME-001.png …, with as many digits as the last one has.
std::vector<std::filesystem::path> turntable_paths(const std::filesystem::path& picture, int count);

/// What is asked for must fit the script; where it does not, the script's diagnostics say so.
Result<void> check_request(Script& script, const RunRequest& request);

/// Everything that could fail at the end of a long run is tried at its beginning. Leaves nothing
/// behind, also nothing of what killed runs left there.
Result<void> check_outputs(const RunRequest& request,
                           std::span<const std::filesystem::path> outputs);
/// Makes the folders, and tries them.
Result<void> check_folders(const RunRequest& request);

/// A picture larger than memory is refused before the run, not after it. `memory` is what the run
/// takes without it.
Result<void> check_picture_size(const DomainSettings& domain, const PictureRequest& picture,
                                double memory, std::uint64_t memory_limit);

}  // namespace cascade
