// Turns options of the command line into statements of a script.
#pragma once

#include "run/script/script.h"

namespace cascade {

/// Adds a statement to `script.tree.options` for each option that overrides a setting of the domain
/// or of all stages, such as `grid: 64, 32` for --grid 64x32. Messages about such a statement show
/// the option as the user typed it. Errors are added to the script's diagnostics.
void add_option_statements(Script& script);

}  // namespace cascade
