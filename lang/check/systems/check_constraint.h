// Constraints: `0 = e` determines the one name in e that has no value (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

namespace cascade::checking {

/// Makes the definition `id`, which a constraint determines, the field that makes `residual` 0.
/// Reports an error where that is not linear in the field.
void solve_constraint(Workspace& work, SystemId system, DefinitionId id, Formula residual);

}  // namespace cascade::checking
