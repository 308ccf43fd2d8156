// `cascade repl`: the language line by line.
#pragma once

#include "app/console.h"
#include "app/options.h"

namespace cascade {

int repl_command(const Options& options, Console& console);

}  // namespace cascade
