// The canonical style of scripts: blanks, line breaks and indentation. spec/formatting.md defines
// it.
//
// Formatting works on words (tokens and comments), not on the tree, so no word of a script is lost.
// A line break may become a `;`, or a `;` a line break, if the meaning stays the same.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cascade {

/// The widest line, in columns, on which a whole block or several statements may be written. On
/// wider lines they are split into several lines.
inline constexpr std::size_t widest_script_line = 100;

/// The spelling of a formatted script: as its author wrote it, in ASCII only, or in the notation of
/// papers as far as possible (∂u/∂t = D ∇²u + u²v).
enum class ScriptNotation { as_written, ascii, papers };

/// The script in the canonical style. Formatting the result again changes nothing. Empty if the
/// script has syntax errors, which are then in `diagnostics`. Other errors, such as unknown names,
/// are ignored.
std::optional<std::string> format_script(SourceId source, const Sources& sources,
                                         Diagnostics& diagnostics,
                                         ScriptNotation notation = ScriptNotation::as_written);

}  // namespace cascade
