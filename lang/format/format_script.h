// The canonical style of scripts: blanks, line breaks and indentation. spec/formatting.md defines
// it.
//
// Formatting works on words (tokens and comments), not on the tree, so no word of a script is lost.
// If the meaning stays the same, a line break may become a `;`, and a `;` may become a line break.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cascade {

/// The largest width, in columns, of a line that contains a whole block or several statements. A
/// wider line is split into several lines.
inline constexpr std::size_t widest_script_line = 100;

/// How the words of the formatted script are spelled: as the author wrote them, in ASCII only, or
/// in the notation of papers as far as possible (∂u/∂t = D ∇²u + u²v).
enum class ScriptNotation { as_written, ascii, papers };

/// The script in the canonical style. Formatting the result again changes nothing. nullopt if the
/// script has syntax errors, which are added to `diagnostics`. Other errors, such as unknown names,
/// are ignored.
std::optional<std::string> format_script(SourceId source, const Sources& sources,
                                         Diagnostics& diagnostics,
                                         ScriptNotation notation = ScriptNotation::as_written);

}  // namespace cascade
