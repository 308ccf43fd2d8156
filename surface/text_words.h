// The words of a line of a text file.
#pragma once

#include <string_view>
#include <vector>

namespace cascade {

/// What stands between blanks, tabs and other white space.
std::vector<std::string_view> words_of(std::string_view line);

}  // namespace cascade
