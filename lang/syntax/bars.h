// The bars of an absolute value: reads |u - v| as the tokens of abs(u - v).
//
// A bar after an operand closes the innermost open bar, and any other bar opens an absolute value.
// If no bar is open, a bar after an operand is reported as the `or` of other languages. But if this
// bar touches the next token and another bar follows on the line, as in `2 |u|`, a missing operator
// is reported.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/token.h"

#include <vector>

namespace cascade {

/// Replaces the bars in a list of tokens. Reports bars that are never closed, and bars that mean
/// `or`.
std::vector<Token> without_bars(const std::vector<Token>& tokens, Diagnostics& diagnostics);

}  // namespace cascade
