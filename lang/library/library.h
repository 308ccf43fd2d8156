// The library of systems: Cascade texts that are embedded in the binary (lang/systems/*.cascade).
//
// A text NAME.cascade holds the system NAME and, mostly, a stage, a domain and a picture that show
// it. Of an embedded text only the system is taken. A script pays for the systems that it names:
// the others are not even parsed.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"

#include <span>
#include <string_view>
#include <vector>

namespace cascade {

/// A file of the library.
struct LibraryText {
    std::string_view file_name;  ///< `gray_scott.cascade`
    std::string_view text;
    /// The system that the file holds: the file's name without its ending.
    constexpr std::string_view system_name() const {
        return file_name.substr(0, file_name.rfind('.'));
    }
};

/// The library, in the order of the alphabet.
std::span<const LibraryText> library_texts();

/// The text that holds the library's system of this name; null where there is none.
const LibraryText* find_library_text(std::string_view system_name);

/// One text of the library, read for a check.
struct LibraryScript {
    ast::Script script;
    std::size_t block = 0;  ///< Of the system, in script.blocks.
};

/// The systems of the library that a script needs: those which its stages and derived systems name,
/// and those from which these are derived, each after the one it is derived from. A system that
/// the script declares itself is not looked for, unless it is derived from one of its name.
/// The texts are added to `sources`; an equal one of an earlier call is used again.
std::vector<LibraryScript> read_library(const ast::Script& script, Sources& sources,
                                        Diagnostics& diagnostics);

}  // namespace cascade
