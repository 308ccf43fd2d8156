// Second derivatives by time: u'' = e is u' = u_t and u_t' = e (internal to the parser).
#pragma once

#include "lang/syntax/ast.h"

#include <string_view>

namespace cascade {

/// The species that is the rate of another one: u_t of u.
std::string_view name_of_rate(std::string_view species);

/// The parser has read each u'' = e of the block as u_t' = e. Adds u' = u_t, and u_t: 0 if the
/// block gives u_t no value. A block with a base leaves the value to the base.
void complete_second_rates(ast::Script& script, ast::Block& block);

}  // namespace cascade
