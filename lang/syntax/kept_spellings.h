// Spellings that are not in a source as they stand.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A copy of the text that lives as long as the process; equal texts share one. Any thread may call
/// it.
std::string_view kept_spelling(const std::string& text);

/// Is this the spelling of a number? That of a number which the parser has added, such as the
/// starting value of u_t for u'' = e, is not: its place is that of other words.
bool is_spelling_of_number(std::string_view text);

}  // namespace cascade
