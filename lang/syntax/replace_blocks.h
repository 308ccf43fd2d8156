// Adds blocks to a script; a block replaces the one of the same name.
#pragma once

#include <string>

namespace cascade {

/// A script with further blocks and functions. One whose kind and name the script has already takes
/// the place of that one: a stage, a system, a function, the domain, the picture. Others come at
/// the end. So does a text with errors, as a whole, and one with statements of classic stages.
std::string with_blocks(const std::string& script, const std::string& added);

}  // namespace cascade
