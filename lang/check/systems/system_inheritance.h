// Inheritance: `system b: a { … }` has the statements of a, changed by its own (internal to the
// checker).
#pragma once

#include "lang/check/systems/declarations.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// A `system` block and the script that it is written in.
struct SystemBlock {
    const ast::Script* script = nullptr;
    const ast::Block* block = nullptr;
    bool built_in = false;
};

/// A system with its own statements and those that it inherits.
struct DerivedSystem {
    SystemBlock from;
    std::vector<SystemStatement> statements;  ///< Those of its bases first.
    std::optional<std::size_t> base;          ///< An index into the same list.
    std::vector<std::size_t> joined;          ///< Of cells: those of the bases after the first.
    bool is_known = true;  ///< False if its base is unknown, which has been reported.
};

/// The systems of `blocks`, each after those it is derived from. The base of a system is a system
/// of the script, else a built-in one; `system a: a { … }` changes the built-in a.
std::vector<DerivedSystem> derive_systems(Workspace& work, const std::vector<SystemBlock>& blocks);

}  // namespace cascade::checking
