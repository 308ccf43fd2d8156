// The options of files that a pattern writes, as JSON.
#pragma once

#include "run/commands/run.h"

#include <string>

namespace cascade {

/// Reads the options of Pattern::write() and Pattern::film(), which have the names and values of
/// the options of `cascade run`. Fails with the name of an option that is unknown or has a wrong
/// value.
Result<RunRequest> file_request(const std::string& options);

}  // namespace cascade
