// Checks a request for a run against its script and against the disk, before the first step.
#pragma once

#include "run/commands/run.h"

#include <span>

namespace cascade {

/// Returns the paths of option -o, or SCRIPT.png if the option is not given.
std::vector<std::filesystem::path> outputs_of(const Script& script, const RunRequest& request);

/// Returns the path of the log: the requested path or, if there is none, a file in the folder of
/// the first output.
std::filesystem::path log_path(const RunRequest& request,
                               const std::filesystem::path& first_output);

/// Returns the paths of a turntable's pictures, NAME-001.png and so on. The numbers have as many
/// digits as the number of the last picture, but at least three.
std::vector<std::filesystem::path> turntable_paths(const std::filesystem::path& picture, int count);

/// Checks whether the request can be fulfilled for this script. Errors are added to the script's
/// diagnostics.
Result<void> check_request(Script& script, const RunRequest& request);

/// Reports an error if the run never reaches the step of `--stop-at`.
void check_stop_at(Script& script, const StopAt& wanted);

/// Tests whether all outputs can be written, so that a long run does not fail at its end. Leaves no
/// new files, and removes temporary files of runs that were killed.
Result<void> check_outputs(const Script& script, const RunRequest& request,
                           std::span<const std::filesystem::path> outputs);
/// Checks whether the formats of the films allow frames of the size that the run draws, and whether
/// frames of that size have room for labels. Fails if `cancel` is set.
Result<void> check_film_sizes(const Script& script, const RunRequest& request,
                              const std::atomic<bool>& cancel);

/// Creates the folders of outputs and tests whether files can be written there. With `tried`,
/// removes the created folders afterwards.
enum class Folders { tried, made };
Result<void> check_folders(const RunRequest& request, Folders folders);

}  // namespace cascade
