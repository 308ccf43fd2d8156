// The library of systems and shapes: Cascade texts that are embedded in the binary
// (lang/systems/*.cascade).
//
// A text NAME.cascade holds the system or the cells NAME and usually a stage, a domain and a
// picture that show it. Scripts use only its system. Texts that a script does not need are not
// parsed.
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
    /// The name of the system or the shape in the file: the file name without its extension.
    constexpr std::string_view system_name() const {
        return file_name.substr(0, file_name.rfind('.'));
    }
};

/// All texts of the library, in alphabetical order.
std::span<const LibraryText> library_texts();
/// The texts of crawling cells (lang/cells/*.cascade), likewise.
std::span<const LibraryText> library_cells();

/// The texts of cell shapes (lang/shapes/*.cascade), likewise.
std::span<const LibraryText> library_shapes();

/// The text of the library's shape of this name. Null if there is none.
const LibraryText* find_shape_text(std::string_view name);
/// The text of the library's system, or cells, of this name. Null if there is none.
const LibraryText* find_library_text(std::string_view system_name);

/// The functions that scripts with cells can call, such as push(k): `fn` statements with docs.
const LibraryText& cell_functions();

/// These functions, parsed. Adds the text to `sources`, or reuses one added by an earlier call.
ast::Script read_cell_functions(Sources& sources, Diagnostics& diagnostics);
/// These functions from sources to which a check of the script has added the text. Otherwise none.
ast::Script cell_functions_of(const Sources& sources);

/// A text of the library, parsed for a check.
struct LibraryScript {
    ast::Script script;
    std::size_t block = 0;  ///< The index of the system or the shape in script.blocks.
};

/// The systems of the library that a script needs, named by its stages and derived systems, and
/// their bases, each after its base. A system declared in the script is not looked up, unless it is
/// derived from one of the same name. Adds the texts to `sources`, or reuses those added by an
/// earlier call.
std::vector<LibraryScript> read_library(const ast::Script& script, Sources& sources,
                                        Diagnostics& diagnostics);

/// The shapes of the library among these names, and their bases, likewise.
std::vector<LibraryScript> read_library_shapes(const std::vector<std::string_view>& names,
                                               Sources& sources, Diagnostics& diagnostics);

}  // namespace cascade
