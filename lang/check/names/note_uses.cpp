// Records the uses of names. Quantities that every system of a kind has, such as t of a shape, have
// no declaration and are left out.
#include "lang/check/names/note_uses.h"

namespace cascade::checking {

void note_use(Workspace& work, Span use, Span declaration) {
    if (work.uses != nullptr) work.uses->push_back({use, declaration});
}

void note_use(Workspace& work, Span use, SystemId index,
              const std::variant<ItemId, DefinitionId>& id) {
    if (work.uses == nullptr || index == unknown_system) return;
    const System& system = work.program.systems[index];
    if (const auto* definition = std::get_if<DefinitionId>(&id)) {
        return note_use(work, use, system.definitions[*definition].span);
    }
    const ItemId item = std::get<ItemId>(id);
    if (item >= system.frozen_item()) return;
    const Span declaration = system.quantities[item].span;
    if (declaration != system.span) note_use(work, use, declaration);
}

void note_declarations(Workspace& work, SystemId index) {
    const System& system = work.program.systems[index];
    note_use(work, system.span, system.span);
    std::vector<SystemId> bases = system.joined;
    if (system.base) bases.push_back(*system.base);
    const auto note = [&](const auto& declared) {
        if (declared.span == system.span) return;
        note_use(work, declared.span, declared.span);
        for (const SystemId base : bases) {
            const Meaning* meaning = find(work.names[base], declared.name);
            if (meaning != nullptr && !meaning->has_error)
                note_use(work, declared.span, base, meaning->id);
        }
    };
    for (const Quantity& quantity : system.quantities) note(quantity);
    for (const Definition& definition : system.definitions) note(definition);
}

void note_use(Workspace& work, const Scope& scope, const Node& node, Span use) {
    if (const auto* item = node.as<ItemId>()) return note_use(work, use, scope.system, *item);
    if (const auto* rate = node.as<Rate>()) return note_use(work, use, scope.system, rate->species);
    if (const auto* id = node.as<DefinitionId>()) return note_use(work, use, scope.system, *id);
    const auto* sensed = node.as<SensedItem>();
    const auto* other = sensed != nullptr ? &sensed->item : node.as<StageItem>();
    if (other == nullptr) return;
    note_use(work, use, work.program.stages[other->stage].system, other->item);
}

}  // namespace cascade::checking
