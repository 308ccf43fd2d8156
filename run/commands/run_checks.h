// Checks a request against its script and the disk before the first step.
#pragma once

#include "run/commands/run.h"

#include <span>

namespace cascade {

/// The outputs of -o, or SCRIPT.png by default.
std::vector<std::filesystem::path> outputs_of(const Script& script, const RunRequest& request);

/// The file of the log: as requested, else beside the first output.
std::filesystem::path log_path(const RunRequest& request,
                               const std::filesystem::path& first_output);

/// The pictures of a turntable: NAME-001.png …, with enough digits for the last one.
std::vector<std::filesystem::path> turntable_paths(const std::filesystem::path& picture, int count);

/// Checks that the request fits the script; reports errors in the script's diagnostics.
Result<void> check_request(Script& script, const RunRequest& request);

/// Reports a `--stop-at` that the run never reaches.
void check_stop_at(Script& script, const StopAt& wanted);

/// Tests all outputs for writing, so that a long run does not fail at its end. Leaves no files, and
/// removes temporary files of killed runs.
Result<void> check_outputs(const Script& script, const RunRequest& request,
                           std::span<const std::filesystem::path> outputs);
/// Checks that the formats of the films hold frames of the size that the run draws, and that these
/// have room for labels. Fails once `cancel` is set.
Result<void> check_film_sizes(const Script& script, const RunRequest& request,
                              const std::atomic<bool>& cancel);

/// Creates the folders, and tests them for writing. Those that are tried are removed again.
enum class Folders { tried, made };
Result<void> check_folders(const RunRequest& request, Folders folders);

}  // namespace cascade
