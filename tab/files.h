// The files that a page carries for its script: a tab has no others.
#pragma once

#include <string>

namespace cascade {

/// Adds a file, or replaces it. Names are relative to the folder of the script.
void carry_file(std::string name, std::string bytes);

}  // namespace cascade
