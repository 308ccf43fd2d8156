// Orders values that depend on each other, and reports cycles.
#include "lang/check/systems/check_cycles.h"

#include "lang/check/expressions/check_expression.h"
#include "lang/program/dependencies.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

void report_cycle(Workspace& work, Span span, const char* what,
                  const std::vector<std::string>& names) {
    if (names.size() == 1) {
        work.diagnostics.error(span, fmt::format("{} needs its own value: {}", names[0],
                                                 describe_cycle(names)));
        return;
    }
    work.diagnostics.error(span, fmt::format("{} need each other in a cycle: {}", what,
                                             describe_cycle(names)));
}

/// Where a formula reads a value of this kind.
Span place_of(const Formula& formula, const NodeKind& kind) {
    for (const Node& node : formula.nodes) {
        if (node.is(kind)) return node.span;
    }
    return formula.nodes.empty() ? Span{} : formula.nodes.back().span;
}

void report_step_cycle(Workspace& work, const System& system,
                       const std::vector<std::uint32_t>& cycle) {
    const auto count = static_cast<std::uint32_t>(system.definitions.size());
    std::vector<std::string> names;
    for (const std::uint32_t value : cycle) {
        names.push_back(value < count ? system.definitions[DefinitionId(value)].name
                                      : system.quantities[ItemId(value - count)].name + "'");
    }
    const auto& formula = cycle[0] < count ? system.definitions[DefinitionId(cycle[0])].formula
                                           : system.rates[ItemId(cycle[0] - count)];
    const std::uint32_t next = cycle[1 % cycle.size()];
    const NodeKind read = next < count ? NodeKind(DefinitionId(next)) : Rate{ItemId(next - count)};
    report_cycle(work, place_of(formula, read), "definitions and rates", names);
}

/// Checks how deeply operators are nested, also through definitions and rates.
void check_depths(Workspace& work, const System& target) {
    IdVector<DefinitionId, std::uint32_t> definitions(target.definitions.size());
    IdVector<ItemId, std::uint32_t> rates(target.quantities.size());
    const auto of_leaf = [&](const Node& node) {
        if (const auto* definition = node.as<DefinitionId>()) return definitions[*definition];
        const auto* rate = node.as<Rate>();
        return rate != nullptr ? rates[rate->species] : 0;
    };
    const auto count = static_cast<std::uint32_t>(definitions.size());
    for (const std::uint32_t value : topological_order(step_dependencies(target)).order) {
        if (value < count) {
            const DefinitionId id(value);
            definitions[id] = check_nesting(work, target.definitions[id].formula, of_leaf);
        } else {
            const ItemId species(value - count);
            rates[species] = check_nesting(work, target.rates[species], of_leaf);
        }
    }
}

}  // namespace

void report_item_cycle(Workspace& work, const System& system,
                       const std::vector<const Formula*>& items,
                       const std::vector<bool>& from_system,
                       const std::vector<std::uint32_t>& cycle) {
    std::size_t first = 0;
    while (first + 1 < cycle.size() && from_system[cycle[first]]) ++first;
    if (from_system[cycle[first]]) first = 0;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        names.emplace_back(system.item_name(ItemId(cycle[(first + i) % cycle.size()])));
    }
    const ItemId next(cycle[(first + 1) % cycle.size()]);
    report_cycle(work, place_of(*items[cycle[first]], next), "values", names);
}

void report_cycles_of_defaults(Workspace& work, SystemId index) {
    const System& system = work.program.systems[index];
    std::vector<const Formula*> items;
    for (const Quantity& quantity : system.quantities) items.push_back(&quantity.start);
    const Settings& settings = system.settings;
    items.push_back(settings.frozen ? &*settings.frozen : nullptr);
    items.push_back(settings.speed ? &*settings.speed : nullptr);
    const Order order = topological_order(item_dependencies(items));
    const std::vector<bool> from_system(items.size(), false);
    for (const auto& cycle : order.cycles) {
        report_item_cycle(work, system, items, from_system, cycle);
    }
}

void order_steps(Workspace& work, SystemId index) {
    System& target = work.draft->systems[index];
    const Order order = topological_order(step_dependencies(target));
    for (const auto& cycle : order.cycles) report_step_cycle(work, target, cycle);
    const auto count = static_cast<std::uint32_t>(target.definitions.size());
    IdVector<DefinitionId, DefinitionId> position(count);
    IdVector<DefinitionId, Definition> definitions;
    IdVector<DefinitionId, bool> read;
    for (const std::uint32_t value : order.order) {
        if (value < count) {
            const DefinitionId id(value);
            position[id] = definitions.next();
            definitions.push_back(std::move(target.definitions[id]));
            read.push_back(work.definitions_read[index][id]);
        } else if (const ItemId item(value - count); target.is_species(item)) {
            target.rate_order.push_back(item);
        }
    }
    target.definitions = std::move(definitions);
    work.definitions_read[index] = std::move(read);
    const auto renumber = [&](Formula& formula) {
        for (Node& node : formula.nodes) {
            if (const auto* id = node.as<DefinitionId>()) node.kind = position[*id];
        }
    };
    if (target.cells) {
        for (DefinitionId* id : {&target.cells->velocity, &target.cells->spin}) *id = position[*id];
    }
    for (Definition& definition : target.definitions) renumber(definition.formula);
    for (Formula& rate : target.rates) renumber(rate);
    for (auto& [name, meaning] : work.names[index]) {
        if (auto* id = std::get_if<DefinitionId>(&meaning.id)) *id = position[*id];
    }
    if (order.cycles.empty()) check_depths(work, target);
}

}  // namespace cascade::checking
