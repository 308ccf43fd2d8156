// The cells of stages (internal to the checker): coarser grids, as `start: coarse(4)` and `grid:
// coarse(4)` ask for them, and patterns of a `size`.
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade::checking {

struct Coarse {
    std::int64_t times = 1;  ///< Cells are this many times as wide: a power of two.
    Span span;
};

/// The value of `setting`, which is coarse(n). Reports an error and returns nothing if it is not;
/// `meaning` is the message where it is not a call of coarse.
std::optional<Coarse> check_coarse(Workspace& work, const ast::Script& script,
                                   ast::Expression value, std::string_view setting,
                                   std::string_view meaning);

/// Coarser grids need straight axes and sides that can be halved often enough.
void check_coarse_grids(const Program& program, Diagnostics& diagnostics);

/// Reports sizes that no trial run can find, or that the domain cannot show. The program must be
/// free of errors otherwise.
void check_sizes(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
