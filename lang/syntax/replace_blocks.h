// Adds blocks to a script, where a block replaces another of the same name, and compares the blocks
// of two scripts.
#pragma once

#include <string>

namespace cascade {

/// A script with further blocks and functions. A block of the same kind and name as one of the
/// script replaces it: a stage, a system, a function, the domain, the picture. Others go to the
/// end, and so does a text with errors, as a whole, and one with statements of classic stages.
std::string with_blocks(const std::string& script, const std::string& added);

/// True if two scripts are the same except for pictures, shapes, comments and blank space. False if
/// one of them has syntax errors.
bool differ_in_pictures_only(const std::string& one, const std::string& other);

}  // namespace cascade
