// Spells the words of a formatted script in the requested notation (internal to the formatter).
#pragma once

#include "lang/format/format_script.h"
#include "lang/format/format_words.h"

#include <vector>

namespace cascade {

/// Spells the words of the formatted script in this notation.
std::vector<FormatWord> written_words(std::vector<FormatWord> words, ScriptNotation notation);

}  // namespace cascade
