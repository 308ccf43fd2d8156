// Spellings that do not occur in a source.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A copy of the text that lives as long as the process. Equal texts share one. Thread-safe.
std::string_view kept_spelling(const std::string& text);

/// Whether this is the spelling of a number in the source. A number added by the parser, such as
/// the starting value of u_t for u'' = e, has the location of other words and does not count.
bool is_spelling_of_number(std::string_view text);

}  // namespace cascade
