// Options of the command line as statements of the language.
#pragma once

#include "run/script/script.h"

namespace cascade {

/// Adds a statement to `script.tree.options` for every override of the domain and of all stages:
/// `grid: 64, 32` for --grid 64x32. Messages about it show the option as it was typed. Errors go to
/// the script's diagnostics.
void add_option_statements(Script& script);

}  // namespace cascade
