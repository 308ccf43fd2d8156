// Inheritance (internal to the checker). The system of `system b: a { … }` has the statements of a,
// changed by the statements of b.
#pragma once

#include "lang/check/systems/declarations.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// A `system` block, and the script that contains it.
struct SystemBlock {
    const ast::Script* script = nullptr;
    const ast::Block* block = nullptr;
    bool built_in = false;
};

/// A system with its own statements and the inherited statements.
struct DerivedSystem {
    SystemBlock from;
    std::vector<SystemStatement> statements;  ///< Statements of its bases come first.
    std::optional<std::size_t> base;          ///< The index of the base in the list of systems.
    /// For cells, the indices of further bases in the list of systems.
    std::vector<std::size_t> joined;
    bool is_known = true;  ///< Whether the bases are known. If not, an error has been reported.
};

/// The systems of `blocks`, each after the systems from which it is derived. A base is a system of
/// the script or, if the script has no system of this name, a library system. `system a: a { … }`
/// changes the library's system a.
std::vector<DerivedSystem> derive_systems(Workspace& work, const std::vector<SystemBlock>& blocks);

}  // namespace cascade::checking
