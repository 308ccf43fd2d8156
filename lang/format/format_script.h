// The canonical style of scripts: blanks, line breaks and indentation. spec/formatting.md defines
// it.
//
// Formatting works on words (tokens and comments), not on the tree, so that every word of a script
// remains. Only line breaks and `;` are exchanged where both mean the same.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cascade {

/// Width beyond which a block or several statements on one line are split into lines.
inline constexpr std::size_t widest_script_line = 100;

/// The spelling of a formatted script: as its author wrote it, in ASCII only, or in the notation of
/// papers where there is one (∂u/∂t = D ∇²u + u²v).
enum class ScriptNotation { as_written, ascii, papers };

/// The script in the canonical style. Formatting the result again changes nothing. Empty if the
/// script has syntax errors, which are then in `diagnostics`. Other errors, such as an unknown
/// name, do not matter.
std::optional<std::string> format_script(SourceId source, const Sources& sources,
                                         Diagnostics& diagnostics,
                                         ScriptNotation notation = ScriptNotation::as_written);

}  // namespace cascade
