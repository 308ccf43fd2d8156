// Checks constraints (internal to the checker). The constraint `0 = e` determines the only name in
// e that has no value otherwise.
#pragma once

#include "lang/check/names/check_names.h"

namespace cascade::checking {

/// Turns the definition `id`, which a constraint determines, into the field for which `residual` is
/// 0. Reports an error if the residual is not linear in this field.
void solve_constraint(Workspace& work, SystemId system, DefinitionId id, Formula residual);

}  // namespace cascade::checking
