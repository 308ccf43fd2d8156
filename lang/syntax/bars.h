// The bars of an absolute value: |u - v|, read as the tokens of abs(u - v).
//
// A bar after an operand closes the bars that are open, and any other one opens a pair. Without
// open bars, a bar after an operand is the `or` of other languages, unless it touches the next
// token and another bar follows on its line, as in `2 |u|`, which lacks an operator.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/token.h"

#include <vector>

namespace cascade {

/// The tokens without bars. Reports bars that are never closed, and bars that mean `or`.
std::vector<Token> without_bars(const std::vector<Token>& tokens, Diagnostics& diagnostics);

}  // namespace cascade
