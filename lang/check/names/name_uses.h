// The uses of names in a script, and the declarations to which they refer.
#pragma once

#include "core/source.h"

#include <vector>

namespace cascade {

/// A use of a name, and the name in the statement or block that declares it. A declaration is a use
/// of itself. If it replaces an inherited declaration, it is also a use of that declaration.
struct NameUse {
    Span use;
    Span declaration;
};

/// The uses of names, in any order. A use may be in the list several times. The span of a use may
/// be larger than the name, as in `[u]` or `u[i]`.
using NameUses = std::vector<NameUse>;

}  // namespace cascade
