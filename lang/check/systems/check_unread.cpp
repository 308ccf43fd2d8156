// Finds values that nothing reads. The names of such values are usually misspelt.
#include "lang/check/systems/check_systems.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace cascade::checking {

namespace {

struct Unread {
    const std::string* name;
    Span span;
    const char* kind;
};

std::string family_of(const std::string& name) { return name.substr(0, name.find('[')); }

/// Finds quantities and definitions that nothing reads. A family gives only one message, and only
/// if none of its members is read.
std::vector<Unread> find_unread(const Workspace& work, SystemId index) {
    const System& system = work.program.systems[index];
    std::unordered_set<std::string> read;
    std::vector<Unread> unread;
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        if (quantity.is_species || work.items_read[index][item]) {
            read.insert(family_of(quantity.name));
        } else {
            unread.push_back({&quantity.name, quantity.span, "parameter"});
        }
    }
    for (const DefinitionId id : system.definitions.ids()) {
        const Definition& definition = system.definitions[id];
        if (work.definitions_read[index][id]) {
            read.insert(family_of(definition.name));
        } else {
            unread.push_back({&definition.name, definition.span, "definition"});
        }
    }
    std::erase_if(unread,
                  [&](const Unread& each) { return !read.insert(family_of(*each.name)).second; });
    return unread;
}

/// Reports a name that a derived system adds and that nothing reads. The author probably wanted to
/// change a value of the base. Names of the base are not reported again.
void report_change_of_nothing(Workspace& work, const System& system, const Unread& unread) {
    const System& base = work.program.systems[*system.base];
    const std::string family = family_of(*unread.name);
    std::vector<SystemId> bases = system.joined;
    bases.push_back(*system.base);
    for (const SystemId each : bases) {
        if (find(work.names[each], *unread.name) != nullptr) return;
        const bool is_member = family != *unread.name;
        if (is_member && has_family(work.program.systems[each], family)) return;
    }
    std::vector<std::string> names = quantity_names(base);
    for (const Definition& definition : base.definitions) names.push_back(definition.name);
    work.diagnostics.error(unread.span,
                           fmt::format("{} has no '{}' to change, and no formula reads this name",
                                       base.name, family),
                           did_you_mean(work, *unread.name, names));
}

/// A hint for names such as `u_dot`, if u is a quantity.
std::string hint_of_rate(const Workspace& work, SystemId system, std::string_view name) {
    const std::string_view species = species_of_rate(name);
    const bool is_known = !species.empty() && find(work.names[system], species) != nullptr;
    return is_known ? fmt::format("a rate is written {}' = …", species) : "";
}

}  // namespace

void warn_unread(Workspace& work) {
    for (const SystemId index : work.program.systems.ids()) {
        const System& system = work.program.systems[index];
        if (system.built_in) continue;
        for (const Unread& unread : find_unread(work, index)) {
            if (system.base) {
                report_change_of_nothing(work, system, unread);
            } else {
                const bool is_parameter = unread.kind == std::string_view("parameter");
                // The context includes settings of stages, because a system may contain defaults
                // for them.
                const auto context = WordContext::stage;
                const auto settings =
                    system.cells ? settings_of({SettingBlock::cells, SettingBlock::stage,
                                                SettingBlock::system})
                                 : settings_of({SettingBlock::stage, SettingBlock::system});
                work.diagnostics.warning(
                    unread.span, fmt::format("{} '{}' is never read", unread.kind, *unread.name),
                    is_parameter ? hint_about(work, *unread.name, context, settings)
                                 : hint_of_rate(work, index, *unread.name));
            }
        }
    }
}

}  // namespace cascade::checking
