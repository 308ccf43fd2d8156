// Definitions that may be numbers, vectors or, in systems of fields, tensors (internal to the
// checker).
#pragma once

#include "lang/check/systems/declarations.h"

namespace cascade::checking {

/// Checks the definitions of a system. Each definition is checked after the definitions that it
/// reads, because their types determine its type. Stores the formulas of the definitions and the
/// types of their names. Skips null elements of `definitions`. Definitions in a cycle are checked
/// in any order, and order_steps() reports the cycle.
void check_typed_definitions(Workspace& work, SystemId system, Context context,
                             const IdVector<DefinitionId, const Declaration*>& definitions);

}  // namespace cascade::checking
