// Makes any text safe for use in a comment of C.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// Returns the text as a single line for a C comment. Blanks are inserted between the characters of
/// comment marks, line continuations and trigraphs. Unprintable characters become question marks.
std::string c_comment(std::string_view text);

}  // namespace cascade
