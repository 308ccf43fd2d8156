// Checks the settings of stages that change the width of cells (internal to the checker): coarser
// grids, written `start: coarse(4)` and `grid: coarse(4)`, and a `size` of the pattern.
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade::checking {

struct Coarse {
    std::int64_t times = 1;  ///< The factor by which the cells are wider: a power of two.
    Span span;
};

/// The value of `setting`, which must be coarse(n). Otherwise reports an error and returns nothing.
/// `meaning` is the message for a value that is not a call of coarse.
std::optional<Coarse> check_coarse(Workspace& work, const ast::Script& script,
                                   ast::Expression value, std::string_view setting,
                                   std::string_view meaning);

/// Reports coarser grids on domains whose axes are not straight or whose sides cannot be halved
/// often enough.
void check_coarse_grids(const Program& program, Diagnostics& diagnostics);

/// Reports a `size` that no trial run can find, or that does not fit the domain. The program must
/// have no other errors.
void check_sizes(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
