// Adds blocks to a script, where a block replaces the one of the same name, and compares the blocks
// of two scripts.
#pragma once

#include <string>

namespace cascade {

/// A script with further blocks and functions. One whose kind and name the script has already takes
/// the place of that one: a stage, a system, a function, the domain, the picture. Others come at
/// the end. So does a text with errors, as a whole, and one with statements of classic stages.
std::string with_blocks(const std::string& script, const std::string& added);

/// True if two scripts are the same but for pictures, shapes, comments and blank space. False if
/// one of them has syntax errors.
bool differ_in_pictures_only(const std::string& one, const std::string& other);

}  // namespace cascade
