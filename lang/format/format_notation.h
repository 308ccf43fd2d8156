// The notation of a formatted script (internal to the formatter): the spelling of its words.
#pragma once

#include "lang/format/format_script.h"
#include "lang/format/format_words.h"

#include <vector>

namespace cascade {

/// The words to write, with their texts in this notation.
std::vector<FormatWord> written_words(std::vector<FormatWord> words, ScriptNotation notation);

}  // namespace cascade
