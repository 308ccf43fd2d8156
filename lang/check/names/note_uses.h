// Notes for editors what names refer to (internal to the checker). Does nothing if nobody asks.
#pragma once

#include "lang/check/names/check_names.h"

#include <variant>

namespace cascade::checking {

/// Notes that the name at `use` refers to a declaration.
void note_use(Workspace& work, Span use, Span declaration);
/// The same for a name that means an item or a definition of a system.
void note_use(Workspace& work, Span use, SystemId system,
              const std::variant<ItemId, DefinitionId>& id);
/// The same for a name in an expression, which has become `node`.
void note_use(Workspace& work, const Scope& scope, const Node& node, Span use);

/// Notes that each declaration of a system refers to itself, and to one of its name in a base.
void note_declarations(Workspace& work, SystemId system);

}  // namespace cascade::checking
