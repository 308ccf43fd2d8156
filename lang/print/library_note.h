// Descriptions of the texts of the library, for readers and for searches.
#pragma once

#include "lang/library/library.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct LibraryNote {
    std::string about;               ///< The first sentence of the comment at the top.
    std::vector<std::string> lines;  ///< The lines of the comment at the top, with the description
                                     ///< and the sources.
    std::string words;               ///< The name, comments and strings of the text, in lower case.

    /// Whether the word occurs in the name, the comments or the strings, regardless of case.
    bool mentions(std::string_view word) const;
};

/// Reads the description of a text from the comment at its top.
LibraryNote note_of(const LibraryText& text);

/// A script with which users can begin: the text of a library system, of cells or of a shape. If
/// the text has no stage, a stage is added, so that the script can run.
std::string starting_script(const LibraryText& text);

}  // namespace cascade
