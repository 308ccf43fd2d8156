// Inheritance (internal to the checker): `system b: a { … }` has the statements of a, changed by
// its own statements.
#pragma once

#include "lang/check/systems/declarations.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// A `system` block and the script in which it is written.
struct SystemBlock {
    const ast::Script* script = nullptr;
    const ast::Block* block = nullptr;
    bool built_in = false;
};

/// A system with its own statements and the inherited ones.
struct DerivedSystem {
    SystemBlock from;
    std::vector<SystemStatement> statements;  ///< Statements of its bases come first.
    std::optional<std::size_t> base;          ///< The base's index in the list of systems.
    std::vector<std::size_t> joined;          ///< For cells: indices of further bases.
    bool is_known = true;  ///< False if its base is unknown. An error has then been reported.
};

/// The systems of `blocks`. Each comes after the systems from which it is derived. A base is a
/// system of the script or, if the script has no system of this name, a library system. `system a:
/// a { … }` changes the library's system a.
std::vector<DerivedSystem> derive_systems(Workspace& work, const std::vector<SystemBlock>& blocks);

}  // namespace cascade::checking
