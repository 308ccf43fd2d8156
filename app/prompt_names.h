// What can follow at the end of a line that is being typed.
#pragma once

#include "lang/program/program.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Names that may begin the word at the end of a line, for completion: after `STAGE.` the items of
/// that stage, after a command what it takes (items, stages, files), else all names of the
/// language and of the program.
std::vector<std::string> names_at_end(std::string_view line, const Program& program);

}  // namespace cascade
