// The table of `--timing`.
#pragma once

#include "run/stage/time_account.h"

#include <string>

namespace cascade {

/// Where the time of a run went: a line for each part with its share of everything, for each stage
/// where there are several; with bars after the shares if `bars`. Ends with a line end.
std::string time_table(TimeAccount& account, bool bars);

}  // namespace cascade
