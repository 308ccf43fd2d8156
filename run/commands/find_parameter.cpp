// Compares the names of the stage's quantities.
#include "run/commands/find_parameter.h"

#include "core/near_name.h"
#include "lang/syntax/script_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cascade {

Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view asked) {
    const System& system = program.system_of(stage);
    std::string_view name = asked;
    for (const std::string& owner : {program.stages[stage].name, system.name}) {
        if (name.starts_with(owner) && name.substr(owner.size()).starts_with(".")) {
            name.remove_prefix(owner.size() + 1);
            break;
        }
    }
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

double unit_factor(const ast::Script& script, std::string_view name) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    const std::string_view stage = dot < name.size() ? name.substr(0, dot) : std::string_view();
    if (dot < name.size()) name.remove_prefix(dot + 1);
    const std::string_view unit = unit_of_value(script, stage, name.substr(0, name.find('[')));
    return unit.empty() ? 1 : units_of(script).convert(1, unit_of(unit));
}

}  // namespace cascade
