// The uses of names in a script, and the declarations to which they refer.
#pragma once

#include "core/source.h"

#include <vector>

namespace cascade {

/// A use of a name, and the name in the statement or block that declares it. A declaration counts
/// as a use of itself, and as a use of the inherited declaration that it replaces.
struct NameUse {
    Span use;
    Span declaration;
};

/// Uses in any order. A use may occur several times. The span of a use may be larger than the name,
/// as in `[u]` or `u[i]`.
using NameUses = std::vector<NameUse>;

}  // namespace cascade
