// Arbitrary text in a comment of C.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// The text as one line that is safe in a C comment: blanks break up comment marks, line
/// continuations and trigraphs, and unprintable characters become question marks.
std::string c_comment(std::string_view text);

}  // namespace cascade
