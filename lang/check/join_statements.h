// Several bases of one block of cells, `cells a: b, c { … }` (internal to the checker).
#pragma once

#include "lang/check/declarations.h"

#include <vector>

namespace cascade::checking {

/// Adds the statements of a further base to those of the bases before it. All terms of rates are
/// kept, in order. What two bases say of one name must be the same, unless `block`, which is
/// derived from them, says it itself; reports an error otherwise. Statements that both have from a
/// common base stand once. Afterwards no statement replaces another one: all are of level 0.
void join_statements(Workspace& work, std::vector<SystemStatement>& statements,
                     const std::vector<SystemStatement>& more, const ast::Block& block);

}  // namespace cascade::checking
