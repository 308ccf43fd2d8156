// The table of `--timing`.
#pragma once

#include "ranks/rank_load.h"
#include "run/stage/time_account.h"

#include <span>
#include <string>

namespace cascade {

/// Describes how the time of a run was spent: a line for each category with its fraction of the
/// time, and a line for each stage if there are several. `bars` adds a bar to each line. Ends with
/// a newline.
std::string time_table(TimeAccount& account, bool bars);

/// Describes the costs of steps in a line for each rank: its machine, processor time in kernels and
/// copies, time in messages, and bytes of halos. Ends with a newline.
std::string rank_table(std::span<const RankLoad> loads);

}  // namespace cascade
