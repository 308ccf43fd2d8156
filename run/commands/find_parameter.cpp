// Compares the names of the stage's quantities.
#include "run/commands/find_parameter.h"

#include "core/near_name.h"
#include "lang/syntax/script_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cascade {

namespace {

struct OwnedName {
    std::string_view owner;  ///< A stage or a system. Empty without a dot.
    std::string_view name;
};

/// Divides a name such as "spots.feed" at its first dot.
OwnedName owner_and_name(std::string_view text) {
    const std::size_t dot = text.find('.');
    if (dot == std::string_view::npos) return {"", text};
    return {text.substr(0, dot), text.substr(dot + 1)};
}

}  // namespace

Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view asked) {
    const System& system = program.system_of(stage);
    const auto [owner, owned] = owner_and_name(asked);
    const bool is_owned = owner == program.stages[stage].name || owner == system.name;
    const std::string_view name = is_owned ? owned : asked;
    std::vector<std::string> names;
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        if (quantity.is_species) continue;
        names.push_back(quantity.name);
        if (quantity.name != name) continue;
        if (!program.stages[stage].uniform[item]) {
            return failure(
                fmt::format("'{}' differs from cell to cell and cannot be varied", quantity.name));
        }
        return item;
    }
    const std::string near = nearest_name(std::string(name), names);
    return failure(fmt::format("stage '{}' has no parameter '{}'", program.stages[stage].name,
                               asked),
                   near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

std::string_view unit_of_numbers(const ast::Script& script, std::string_view asked) {
    const auto [stage, name] = owner_and_name(asked);
    return unit_of_value(script, stage, name.substr(0, name.find('[')));
}

double unit_factor(const ast::Script& script, std::string_view name) {
    const std::string_view unit = unit_of_numbers(script, name);
    return unit.empty() ? 1 : units_of(script).convert(1, unit_of(unit));
}

Result<double> unit_factor(const ast::Script& script, const VariedRange& range) {
    if (range.unit.empty()) return unit_factor(script, range.name);
    const std::string_view of_value = unit_of_numbers(script, range.name);
    const Unit unit = unit_of(range.unit);
    if (of_value.empty() || unit_of(of_value).dimension != unit.dimension) {
        return failure(fmt::format("the range of '{}' is in {}, but its value is {}{}", range.name,
                                   range.unit, of_value.empty() ? "a number without a unit" : "in ",
                                   of_value));
    }
    return units_of(script).convert(1, unit);
}

}  // namespace cascade
