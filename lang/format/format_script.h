// The one style of scripts: blanks, lines and indentation. spec/formatting.md says what it is.
//
// Formatting works on words (tokens and comments) and never on the tree, so that everything a
// script says stays word for word; only line ends and `;` come and go where both mean the same.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cascade {

/// What a line holds before a block or a row of statements is put on lines of its own, in columns.
inline constexpr std::size_t widest_script_line = 100;

/// The script in the one style. Formatting the result again changes nothing. Empty where the script
/// cannot be read: then `diagnostics` says why. Faults of meaning (an unknown name) do not matter.
std::optional<std::string> format_script(SourceId source, const Sources& sources,
                                         Diagnostics& diagnostics);

}  // namespace cascade
