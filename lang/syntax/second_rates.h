// Second derivatives with respect to time: u'' = e means u' = u_t and u_t' = e (internal to the
// parser).
#pragma once

#include "lang/syntax/ast.h"

#include <string_view>

namespace cascade {

/// The name of the species whose value is the rate of `species`: u_t for u.
std::string_view name_of_rate(std::string_view species);

/// Completes a block in which the parser has read each u'' = e as u_t' = e. Adds u' = u_t. Also
/// adds u_t: 0, unless the block sets u_t, or has a base that may set it.
void complete_second_rates(ast::Script& script, ast::Block& block);

}  // namespace cascade
