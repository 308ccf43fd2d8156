// Adds blocks to a script, and compares the blocks of two scripts. An added block replaces a block
// of the same name.
#pragma once

#include <string>

namespace cascade {

/// Adds blocks and functions to a script. An added block replaces a block of the same kind and
/// name: a stage, a system, a function, the domain, or the picture. Other blocks are added at the
/// end. If `added` has errors or contains classic stages, it is added at the end as a whole.
std::string with_blocks(const std::string& script, const std::string& added);

/// Whether two scripts are equal except for pictures, shapes, comments and blank space. False if
/// one of them has syntax errors.
bool differ_in_pictures_only(const std::string& one, const std::string& other);

}  // namespace cascade
