// What the prompt must know about lines before they are parsed: whether one is complete, and how
// the word at its end can continue.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// False while a bracket is open, or the last line ends in a comma or an operator. Comments and
/// strings do not count.
bool is_complete(std::string_view text);

/// True for blank lines and comments.
bool says_nothing(std::string_view line);

/// How the word at the end of a line can continue.
struct Completion {
    std::string insert;                ///< What all choices have in common after the word.
    std::vector<std::string> choices;  ///< Sorted, without repetition.
};

/// A word is made of letters, digits and _; a ':' at the start of the line belongs to it. A space
/// follows if there is only one choice.
Completion complete_word(std::string_view line, std::vector<std::string> names);

/// `text` without white space at both ends.
std::string_view trim(std::string_view text);

/// The words of a command as a shell sees them: divided at blanks, except between quotes.
std::vector<std::string> words_of(std::string_view text);

}  // namespace cascade
