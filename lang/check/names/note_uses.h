// Records for editors to which declaration each name refers (internal to the checker). The
// functions do nothing if Workspace::uses is null.
#pragma once

#include "lang/check/names/check_names.h"

#include <variant>

namespace cascade::checking {

/// Records that the name at `use` refers to a declaration.
void note_use(Workspace& work, Span use, Span declaration);
/// Records that the name at `use` refers to an item or a definition of a system.
void note_use(Workspace& work, Span use, SystemId system,
              const std::variant<ItemId, DefinitionId>& id);
/// Records the declaration of a name in an expression. `node` is the name's node.
void note_use(Workspace& work, const Scope& scope, const Node& node, Span use);

/// Records each declaration in a system as a use of itself. If a base declares the same name, also
/// records it as a use of that declaration.
void note_declarations(Workspace& work, SystemId system);

}  // namespace cascade::checking
