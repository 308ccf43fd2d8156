// The library of systems, cells and shapes: Cascade texts that are embedded in the program
// (lang/systems/*.cascade and others).
//
// A text NAME.cascade contains the system, cells or shape NAME, and usually a stage, a domain and a
// picture that show it. A script that names NAME uses only the system, cells or shape. Texts that a
// script does not need are not parsed.
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
    /// The name of the system, cells or shape in the file: the file name without its extension.
    constexpr std::string_view system_name() const {
        return file_name.substr(0, file_name.rfind('.'));
    }
};

/// All texts of systems, in alphabetical order.
std::span<const LibraryText> library_texts();
/// The texts of crawling cells (lang/cells/*.cascade), in alphabetical order.
std::span<const LibraryText> library_cells();

/// The texts of shapes of cells (lang/shapes/*.cascade), in alphabetical order.
std::span<const LibraryText> library_shapes();

/// The text of the library's shape with this name; null if there is none.
const LibraryText* find_shape_text(std::string_view name);
/// The text of the library's system or cells with this name; null if there is none.
const LibraryText* find_library_text(std::string_view system_name);

/// The functions that scripts with cells can call, such as push(k). The text consists of `fn`
/// statements with doc comments.
const LibraryText& cell_functions();

/// Parses the text of cell_functions(). Adds the text to `sources`, or reuses the text that an
/// earlier call has added.
ast::Script read_cell_functions(Sources& sources, Diagnostics& diagnostics);
/// Parses the text of cell_functions() if the check of a script has added it to `sources`.
/// Otherwise returns an empty script.
ast::Script cell_functions_of(const Sources& sources);

/// A text of the library, parsed for a check.
struct LibraryScript {
    ast::Script script;
    std::size_t block = 0;  ///< The index of the text's system, cells or shape in script.blocks.
};

/// The library systems that a script needs: the systems to which its stages and derived systems
/// refer, and their bases. In the result, each system comes after its bases. A system that the
/// script declares is not taken from the library, unless it is derived from a library system of the
/// same name. Adds the
/// texts to `sources`, or reuses the texts that an earlier call has added.
std::vector<LibraryScript> read_library(const ast::Script& script, Sources& sources,
                                        Diagnostics& diagnostics);

/// The library shapes with these names, and their bases. In the result, each shape comes after its
/// base. Names that are not library shapes are ignored. Adds the texts to `sources`, or reuses the
/// texts that an earlier call has added.
std::vector<LibraryScript> read_library_shapes(const std::vector<std::string_view>& names,
                                               Sources& sources, Diagnostics& diagnostics);

}  // namespace cascade
