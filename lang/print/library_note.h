// What a text of the library says about itself for people to read and to search.
#pragma once

#include "lang/library/library.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct LibraryNote {
    std::string about;               ///< One line: the first statement of the text's head.
    std::vector<std::string> lines;  ///< The whole head, a line each: description and sources.
    std::string words;               ///< Name, comments and texts in quotes, in small letters.

    /// Is this found in the name, the comments or the texts? Large letters are as small ones.
    bool mentions(std::string_view word) const;
};

/// The head of a text is the comment that it begins with.
LibraryNote note_of(const LibraryText& text);

/// A script that is the library's text of a system, with a stage if the text has none.
std::string starting_script(const LibraryText& text);

}  // namespace cascade
