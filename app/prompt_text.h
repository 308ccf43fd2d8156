// Examines lines at the prompt before they are parsed. Finds out whether they are complete, and how
// their last word can continue.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Whether a text is complete. It is incomplete while a bracket is open, or if its last line ends
/// in a comma or an operator. Brackets in comments and strings are ignored.
bool is_complete(std::string_view text);

/// Whether the line is blank or contains only a comment.
bool says_nothing(std::string_view line);

/// The ways in which the last word of a line can continue.
struct Completion {
    std::string insert;                ///< The text to insert. All choices begin with it.
    std::vector<std::string> choices;  ///< The choices, sorted and without repetitions.
};

/// Completes the word at the end of a line. A word consists of letters, digits and _. At the start
/// of the line it may also contain ':'. If there is only one choice, a space is inserted after it.
Completion complete_word(std::string_view line, std::vector<std::string> names);

/// Returns `text` without white space at both ends.
std::string_view trim(std::string_view text);

/// Divides a command into words at blanks that are not between quotes, as a shell does.
std::vector<std::string> words_of(std::string_view text);

}  // namespace cascade
