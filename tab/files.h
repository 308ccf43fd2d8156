// The files that a page carries for its script. A tab has no others.
#pragma once

#include <string>

namespace cascade {

/// Adds or replaces a file. Names are relative to the folder of the script.
void carry_file(std::string name, std::string bytes);

}  // namespace cascade
