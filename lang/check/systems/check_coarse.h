// Checks the settings of stages that change the width of cells (internal to the checker): coarser
// grids, as in `start: coarse(4)` and `grid: coarse(4)`, and the `size` of the pattern.
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade::checking {

struct Coarse {
    std::int64_t times = 1;  ///< How many times as wide the cells are: a power of two.
    Span span;
};

/// The value of `setting`, which must be coarse(n). If it is not, reports an error and returns
/// nullopt. `meaning` is the message for a value that is not a call of coarse.
std::optional<Coarse> check_coarse(Workspace& work, const ast::Script& script,
                                   ast::Expression value, std::string_view setting,
                                   std::string_view meaning);

/// Reports coarser grids on a domain whose axes are not straight. Reports coarser grids if the
/// sides of the domain cannot be halved often enough.
void check_coarse_grids(const Program& program, Diagnostics& diagnostics);

/// Reports a `size` that no trial run can find, or that does not fit the domain. The program must
/// have no other errors.
void check_sizes(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
