// What the prompt must know of lines before the parser sees them: is one complete, and how may a
// word go on?
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// False while a bracket is open, or the last line ends in a comma or an operator: more must come.
/// Brackets in comments and in texts in quotes do not count.
bool is_complete(std::string_view text);

/// True for blank lines and comments.
bool says_nothing(std::string_view line);

/// How the word at the end of a line can go on.
struct Completion {
    std::string insert;                ///< What all choices have in common after the word.
    std::vector<std::string> choices;  ///< In order, without repetition.
};

/// A word is of letters, digits and _; a ':' at the begin of the line belongs to it. Where only one
/// name is left a space is put after it.
Completion complete_word(std::string_view line, std::vector<std::string> names);

/// A text without white space at its ends.
std::string_view trim(std::string_view text);

}  // namespace cascade
