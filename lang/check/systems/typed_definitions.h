// Definitions that may be numbers, vectors or, in systems of fields, tensors (internal to the
// checker).
#pragma once

#include "lang/check/systems/declarations.h"

namespace cascade::checking {

/// Checks the definitions of a system, each after those that it reads, since their types give its
/// own. Writes their formulas and the types of their names. Null entries are skipped; so is the
/// order if there is a cycle, which order_steps() reports.
void check_typed_definitions(Workspace& work, SystemId system, Context context,
                             const IdVector<DefinitionId, const Declaration*>& definitions);

}  // namespace cascade::checking
