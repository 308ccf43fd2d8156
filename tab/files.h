// The files that a page carries for its script. In a browser's tab there are no other files.
#pragma once

#include <string>

namespace cascade {

/// Adds or replaces a file. The name is relative to the folder of the script.
void carry_file(std::string name, std::string bytes);

}  // namespace cascade
