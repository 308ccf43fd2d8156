// Stores spellings of names and numbers that do not occur in a source.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A copy of the text that lives as long as the process. Equal texts share one copy. Thread-safe.
std::string_view kept_spelling(const std::string& text);

/// Whether the text is the spelling of a number in the source. The parser adds some numbers, such
/// as the starting value of u_t for u'' = e, and the text at the location of such a number is
/// something else.
bool is_spelling_of_number(std::string_view text);

}  // namespace cascade
