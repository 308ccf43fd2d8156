// What is said when values read each other in a cycle.
#include "lang/check/check_cycles.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

constexpr std::size_t most_named = 12;

std::string describe(const std::vector<std::string>& names) {
    std::string path;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i == most_named) {
            path += "… -> ";
            break;
        }
        path += names[i] + " -> ";
    }
    return path + names.front();
}

void report_circle(Workspace& work, Span span, const char* what,
                   const std::vector<std::string>& names) {
    if (names.size() == 1) {
        work.diagnostics.error(span, fmt::format("{} needs itself: {}", names[0],
                                                 describe(names)));
        return;
    }
    work.diagnostics.error(span, fmt::format("{} need each other in a circle: {}", what,
                                             describe(names)));
}

/// Where a formula reads a node of this kind and index.
Span place_of(const Formula& formula, NodeKind kind, std::uint32_t index) {
    for (const Node& node : formula.nodes) {
        if (node.kind == kind && node.index == index) return node.span;
    }
    return formula.nodes.empty() ? Span{} : formula.nodes.back().span;
}

}  // namespace

void report_item_circle(Workspace& work, const System& system,
                        const std::vector<const Formula*>& items,
                        const std::vector<bool>& from_system,
                        const std::vector<std::uint32_t>& circle) {
    std::size_t first = 0;
    while (first + 1 < circle.size() && from_system[circle[first]]) ++first;
    if (from_system[circle[first]]) first = 0;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < circle.size(); ++i) {
        names.emplace_back(system.item_name(circle[(first + i) % circle.size()]));
    }
    const std::uint32_t next = circle[(first + 1) % circle.size()];
    report_circle(work, place_of(*items[circle[first]], NodeKind::own, next), "values", names);
}

void report_step_circle(Workspace& work, const System& system,
                        const std::vector<std::uint32_t>& circle) {
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    std::vector<std::string> names;
    for (const std::uint32_t value : circle) {
        names.push_back(value < definition_count
                            ? system.definitions[value].name
                            : system.quantities[value - definition_count].name + "'");
    }
    const auto& formula = circle[0] < definition_count
                              ? system.definitions[circle[0]].formula
                              : system.rates[circle[0] - definition_count];
    const std::uint32_t next = circle[1 % circle.size()];
    const Span span = next < definition_count
                          ? place_of(formula, NodeKind::definition, next)
                          : place_of(formula, NodeKind::rate, next - definition_count);
    report_circle(work, span, "definitions and rates", names);
}

}  // namespace cascade::checking
