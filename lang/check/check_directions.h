// `directions` of a domain with a model (internal to the checker).
#pragma once

#include "lang/check/check_blocks.h"

#include <optional>

namespace cascade::checking {

/// Parses axis(…), gradient(…), curvature_high, curvature_low or keys(…); reports errors.
std::optional<DirectionSettings> check_directions(Workspace& work, const ast::Script& script,
                                                  const ast::Statement& statement);

}  // namespace cascade::checking
