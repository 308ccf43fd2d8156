// What the names of a script refer to, as the checker finds out.
#pragma once

#include "core/source.h"

#include <vector>

namespace cascade {

/// A name that is written at `use`, and the name of the statement or block that declares it. A
/// declaration refers to itself, and to the inherited declaration that it replaces.
struct NameUse {
    Span use;
    Span declaration;
};

/// In any order, with repetitions. The span of a use may hold more than the name: `[u]`, `u[i]`.
using NameUses = std::vector<NameUse>;

}  // namespace cascade
