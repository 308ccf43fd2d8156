// `size` of a stage (internal to the checker).
#pragma once

#include "lang/check/check_expression.h"

#include <optional>

namespace cascade::checking {

/// The value of `size`; reports an error and returns nothing if it is not a length.
std::optional<StageSize> check_size(Workspace& work, const ast::Script& script,
                                    const ast::Statement& statement);

/// Reports sizes that no trial run can find, or that the domain cannot show. The program must be
/// free of errors otherwise.
void check_sizes(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
