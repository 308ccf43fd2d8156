// The table of `--timing`.
#pragma once

#include "run/stage/time_account.h"

#include <string>

namespace cascade {

/// Describes how the time of a run was spent: a line for each category with its fraction of the
/// time, and a line for each stage if there are several. `bars` adds a bar to each line. Ends with
/// a newline.
std::string time_table(TimeAccount& account, bool bars);

}  // namespace cascade
