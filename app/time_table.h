// The table of `--timing`.
#pragma once

#include "run/stage/time_account.h"

#include <string>

namespace cascade {

/// How the time of a run was spent: a line for each part with its share of the total, one for each
/// stage if there are several; with bars if `bars`. Ends with a newline.
std::string time_table(TimeAccount& account, bool bars);

}  // namespace cascade
