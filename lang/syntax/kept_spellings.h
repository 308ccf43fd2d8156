// Stores spellings of names and numbers that do not occur in a source.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A copy of the text that lives as long as the process. Equal texts share one copy. Thread-safe.
std::string_view kept_spelling(const std::string& text);

/// Whether the text is the spelling of a number in the source. False for the locations of numbers
/// that the parser adds, such as the starting value of u_t for u'' = e, because these locations
/// contain other words.
bool is_spelling_of_number(std::string_view text);

}  // namespace cascade
