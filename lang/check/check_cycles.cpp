// What is said when values read each other in a cycle.
#include "lang/check/check_cycles.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

std::string describe_cycle(const std::vector<std::string>& names) {
    constexpr std::size_t most_named = 12;
    std::string path;
    for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) path += names[i] + " -> ";
    if (names.size() > most_named) path += "… -> ";
    return path + names.front();
}

namespace {

void report_cycle(Workspace& work, Span span, const char* what,
                  const std::vector<std::string>& names) {
    if (names.size() == 1) {
        work.diagnostics.error(span,
                               fmt::format("{} needs itself: {}", names[0], describe_cycle(names)));
        return;
    }
    work.diagnostics.error(span, fmt::format("{} need each other in a cycle: {}", what,
                                             describe_cycle(names)));
}

/// Where a formula reads a node of this kind and index.
Span place_of(const Formula& formula, NodeKind kind, std::uint32_t index) {
    for (const Node& node : formula.nodes) {
        if (node.kind == kind && node.index == index) return node.span;
    }
    return formula.nodes.empty() ? Span{} : formula.nodes.back().span;
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
        names.emplace_back(system.item_name(cycle[(first + i) % cycle.size()]));
    }
    const std::uint32_t next = cycle[(first + 1) % cycle.size()];
    report_cycle(work, place_of(*items[cycle[first]], NodeKind::own, next), "values", names);
}

void report_step_cycle(Workspace& work, const System& system,
                       const std::vector<std::uint32_t>& cycle) {
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    std::vector<std::string> names;
    for (const std::uint32_t value : cycle) {
        names.push_back(value < definition_count
                            ? system.definitions[value].name
                            : system.quantities[value - definition_count].name + "'");
    }
    const auto& formula = cycle[0] < definition_count ? system.definitions[cycle[0]].formula
                                                      : system.rates[cycle[0] - definition_count];
    const std::uint32_t next = cycle[1 % cycle.size()];
    const Span span = next < definition_count
                          ? place_of(formula, NodeKind::definition, next)
                          : place_of(formula, NodeKind::rate, next - definition_count);
    report_cycle(work, span, "definitions and rates", names);
}

}  // namespace cascade::checking
