// Reads models of other programs, and makes scripts of them.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"
#include "import/draft.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cascade::importing {

/// The largest file that is imported, in bytes.
inline constexpr std::uint64_t largest_import = std::uint64_t{1} << 28;
/// The largest number of cells of an imported domain.
inline constexpr std::int64_t most_imported_cells = std::int64_t{1} << 26;

/// A file or link to import, and the receiver of messages about it.
struct Import {
    Sources& sources;
    Diagnostics& diagnostics;
    SourceId source = 0;    ///< The bytes of the file.
    std::string name = {};  ///< The name of the file in messages and in the comment of the script.
    std::string stem = {};  ///< The beginning of the names of files beside the script.
    /// Diffusion coefficients that the user gives, by the names of species. For formats whose files
    /// contain none.
    std::map<std::string, std::string> diffusion = {};
    std::string preset = {};  ///< The preset that the user chooses by name, if any.
    std::optional<SourceId> presets = std::nullopt;  ///< A file of further presets.

    std::string_view bytes() const { return sources[source].text(); }
};

/// A format of other programs.
struct ImportFormat {
    std::string_view name;     ///< For example "pattern of Ready".
    std::string_view endings;  ///< For example ".vti", as messages show it.
    bool takes_diffusion;      ///< Whether `--diffusion` has a meaning for the format.
    /// Whether `--preset` and `--presets` have a meaning for the format.
    bool takes_presets;
    bool (*recognises)(std::string_view file, std::string_view bytes);
    /// Reads the file. If it cannot be imported unchanged, reports errors with their positions and
    /// returns an empty optional.
    std::optional<Draft> (*read)(Import& import);
};
std::span<const ImportFormat> import_formats();

/// The format of a file or link. Null if no format recognises it.
const ImportFormat* format_of(std::string_view file, std::string_view bytes);

std::optional<Draft> read_ready(Import& import);
std::optional<Draft> read_visual_pde(Import& import);  // Reads a link, or a preset as JSON.
std::optional<Draft> read_xpp(Import& import);
std::optional<Draft> read_sbml(Import& import);  // Uses libSBML, if this build has it.

}  // namespace cascade::importing
