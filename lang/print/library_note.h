// Descriptions of the texts of the library, for readers and for searches.
#pragma once

#include "lang/library/library.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct LibraryNote {
    std::string about;  ///< The first sentence of the comment at the top of the text.
    /// The lines of the comment at the top of the text, which contains the description and the
    /// sources.
    std::vector<std::string> lines;
    std::string words;  ///< The name, comments and strings of the text, in lower case.

    /// Whether a word occurs in the text's name, comments or strings, in upper or lower case.
    bool mentions(std::string_view word) const;
};

/// Reads the description of a text from the comment at its top.
LibraryNote note_of(const LibraryText& text);

/// A script with which users can begin: the library text of a system, of cells or of a shape. If
/// the text has no stage, a stage is added, so that the script can run.
std::string starting_script(const LibraryText& text);

}  // namespace cascade
