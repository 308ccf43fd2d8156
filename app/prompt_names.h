// Finds the names that can complete a line that is being typed.
#pragma once

#include "lang/program/program.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Returns the names that may complete the word at the end of a line. After `STAGE.` these are the
/// items of that stage, and after a command its possible arguments (items, stages, files). At any
/// other place, they are all names of the language and of the program.
std::vector<std::string> names_at_end(std::string_view line, const Program& program);

}  // namespace cascade
