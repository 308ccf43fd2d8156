// The bars of an absolute value: reads |u - v| as the tokens of abs(u - v).
//
// A bar after an operand closes the innermost open bar, and any other bar opens an absolute value.
// If no bar is open, a bar after an operand is reported as the `or` of other languages. There is
// one exception: if this bar touches the next token and another bar follows on the line, as in `2
// |u|`, the report is that an operator is missing.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/token.h"

#include <vector>

namespace cascade {

/// The tokens, with bars replaced. Reports bars that are never closed, and bars that mean `or`.
std::vector<Token> without_bars(const std::vector<Token>& tokens, Diagnostics& diagnostics);

}  // namespace cascade
