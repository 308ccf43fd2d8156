// The description of a text of the library, to read and to search.
#pragma once

#include "lang/library/library.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct LibraryNote {
    std::string about;               ///< The first sentence of the head, on one line.
    std::vector<std::string> lines;  ///< The lines of the head: description and sources.
    std::string words;               ///< Its name, comments and strings, in lower case.

    /// True if the word occurs in the name, the comments or the strings, regardless of case.
    bool mentions(std::string_view word) const;
};

/// Reads the description of a text. Its head is the comment at its top.
LibraryNote note_of(const LibraryText& text);

/// A script to start from: the library's text of a system, of cells or of a shape, completed to run
/// if it has no stage.
std::string starting_script(const LibraryText& text);

}  // namespace cascade
