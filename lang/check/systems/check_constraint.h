// Checks constraints (internal to the checker). The constraint `0 = e` determines the value of the
// only name in e that has no other value.
#pragma once

#include "lang/check/names/check_names.h"

namespace cascade::checking {

/// Changes the definition `id`, which a constraint determines. It becomes the field for which
/// `residual` is zero. Reports an error if the residual is not linear in this field.
void solve_constraint(Workspace& work, SystemId system, DefinitionId id, Formula residual);

}  // namespace cascade::checking
