// What the options of the command line say, as statements of the language.
#pragma once

#include "run/script/script.h"

namespace cascade {

/// Adds a statement to `script.tree.options` for every override of the domain and of all stages:
/// for
/// --grid 64x32 that is `grid: 64, 32`. Messages about it show the option and what was typed. What
/// cannot be read is a diagnostic.
void add_option_statements(Script& script);

}  // namespace cascade
