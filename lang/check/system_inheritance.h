// Systems from systems: `system b: a { … }` has the statements of a, changed by its own (internal
// to the checker).
#pragma once

#include "lang/check/declarations.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// A `system` block and where it is written.
struct SystemBlock {
    const ast::Script* script = nullptr;
    const ast::Block* block = nullptr;
    bool built_in = false;
};

/// A system with all that is said in it.
struct DerivedSystem {
    SystemBlock from;
    std::vector<SystemStatement> statements;  ///< Those of its bases first.
    std::optional<std::size_t> base;          ///< Its place in the same list.
    bool is_known = true;  ///< False where its base is not known: told; nothing else is said of it.
};

/// The systems of `blocks`, each after the one it is derived from. The base of a system is a
/// system of the script, or else a built-in one; `system a: a { … }` changes the built-in a.
std::vector<DerivedSystem> derive_systems(Workspace& work, const std::vector<SystemBlock>& blocks);

}  // namespace cascade::checking
