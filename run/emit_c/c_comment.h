// Words from anywhere in a comment of C.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// The text in one line that stays a comment: what could end one, begin another, go on in the next
/// line or be a trigraph is taken apart by a blank, and what is not printable becomes a question
/// mark.
std::string c_comment(std::string_view text);

}  // namespace cascade
