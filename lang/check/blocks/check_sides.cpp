// The rules at the sides of the grid. Combines the rules of the domain, the system and the stage,
// and checks that they are compatible.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/side_rules.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

namespace {

/// The rules that `boundary` gives. At the border of a mask there is no flux.
SideSettings sides_of_boundary(const DomainSettings& domain) {
    SideSettings sides;
    const SideRules boundary(domain.grid.boundary);
    for (std::size_t side = 0; side < side_count; ++side) sides[side].kind = boundary.at[side].kind;
    return sides;
}

/// The rules of the domain, which apply to species without own rules.
SideSettings sides_of_domain(const DomainSettings& domain) {
    SideSettings sides = sides_of_boundary(domain);
    for (std::size_t side = 0; side < wall_count; ++side) {
        if (domain.sides[side]) sides[side] = *domain.sides[side];
    }
    return sides;
}

/// Checks whether both sides of each axis are periodic or neither is. If not, reports an error and
/// returns false.
bool are_pairs(Workspace& work, const SideSettings& sides) {
    for (std::size_t side = 0; side < side_count; side += 2) {
        const bool first = sides[side].kind == SideKind::periodic;
        const bool second = sides[side + 1].kind == SideKind::periodic;
        if (first == second) continue;
        const std::size_t other = first ? side + 1 : side;
        const std::size_t periodic = first ? side : side + 1;
        // Points to the species' own rule for one of the two sides, if there is one. Otherwise
        // points to the domain's rule.
        const Span span = sides[other].span.end > 0 ? sides[other].span : sides[periodic].span;
        work.diagnostics.error(
            span,
            fmt::format("{} is {}, but {} is periodic", side_names[other],
                        side_kind_words[static_cast<std::size_t>(sides[other].kind)],
                        side_names[periodic]),
            fmt::format("write a rule for {}, too, or boundary: noflux in the domain",
                        side_names[span == sides[other].span ? periodic : other]));
        return false;
    }
    return true;
}

/// Checks, if there is a mask, whether a species is periodic at the same sides as the domain. This
/// is necessary because the cell beyond a periodic side depends on the mask, and all species share
/// one mask. A definition is periodic at the sides where all species that it reads are periodic. If
/// the check fails, reports an error and returns false.
bool are_periodic_as_boundary(Workspace& work, const SideSettings& sides, std::string_view where) {
    const SideRules boundary(work.program.domain.grid.boundary);
    for (std::size_t side = 0; side < side_count; ++side) {
        const bool is_periodic = sides[side].kind == SideKind::periodic;
        if (is_periodic == (boundary.at[side].kind == SideKind::periodic)) continue;
        work.diagnostics.error(sides[side].span,
                               fmt::format("{}, '{}' must be periodic for all species or for none",
                                           where, side_names[side]),
                               "set it for all species by the domain's boundary, as in boundary: "
                               "periodic, noflux");
        return false;
    }
    return true;
}

/// The rules of a definition. If the definition has none, adds rules. The added rules are periodic
/// or mirrored, depending on the boundary.
SideSettings& sides_of_definition(const DomainSettings& domain, Stage& stage,
                                  DefinitionId definition) {
    auto& all = stage.definition_sides;
    const auto place = std::ranges::lower_bound(all, definition, {}, &DefinitionSides::definition);
    if (place != all.end() && place->definition == definition) return place->sides;
    return all.insert(place, {definition, sides_of_boundary(domain)})->sides;
}

/// Combines the rules of the domain, the system and the stage for each species and definition of a
/// stage.
void resolve(Workspace& work, Stage& stage, const std::vector<SubjectSide>& own) {
    const System& system = work.program.systems[stage.system];
    const SideSettings base = sides_of_domain(work.program.domain);
    const bool is_plain =
        own.empty() && system.sides.empty() &&
        std::none_of(work.program.domain.sides.begin(), work.program.domain.sides.end(),
                     [](const auto& side) { return side.has_value(); });
    if (is_plain) return;
    IdVector<ItemId, SpeciesId> species(system.quantities.size());
    for (const ItemId item : system.species()) {
        species[item] = stage.sides.next();
        stage.sides.push_back(base);
    }
    for (const auto* rules : {&system.sides, &own}) {
        for (const SubjectSide& rule : *rules) {
            const auto* item = std::get_if<ItemId>(&rule.subject);
            auto& sides = item != nullptr
                              ? stage.sides[species[*item]]
                              : sides_of_definition(work.program.domain, stage,
                                                    std::get<DefinitionId>(rule.subject));
            sides[static_cast<std::size_t>(rule.side)] = rule.setting;
        }
    }
    if (work.program.domain.model) {
        // Rules at sides have no effect on a model, because the border of a model has no flux.
        const auto ignore = [&](const SideSettings& sides) {
            for (const SideSetting& side : sides) {
                if (!takes_value(side.kind)) continue;
                work.diagnostics.warning(side.span,
                                         "this side is ignored, because a model has "
                                         "no sides");
            }
        };
        for (const SideSettings& sides : stage.sides) ignore(sides);
        for (const DefinitionSides& each : stage.definition_sides) ignore(each.sides);
        stage.definition_sides.clear();
        return stage.sides.clear();
    }
    if (!work.program.domain.mask) {
        for (SideSettings& sides : stage.sides) leave_border(work, sides.back());
        for (DefinitionSides& each : stage.definition_sides) leave_border(work, each.sides.back());
    }
    for (const SideSettings& sides : stage.sides) {
        if (!are_pairs(work, sides)) return;
        if (work.program.domain.mask &&
            !are_periodic_as_boundary(work, sides, "in a domain with a mask")) {
            return;
        }
        if (!stage.definition_sides.empty() &&
            !are_periodic_as_boundary(work, sides, "where a definition has a side")) {
            return;
        }
    }
    for (const DefinitionSides& each : stage.definition_sides) {
        if (!are_pairs(work, each.sides)) return;
    }
}

/// Converts a rule of the system `from` to a rule of the system `derived`, which is derived from
/// `from`. In `derived`, the same names have other ids and may have other meanings. Reports an
/// error and returns false if the rule cannot be computed in the derived system.
bool take_over(Workspace& work, const System& from, SystemId derived, SubjectSide& side) {
    const System& system = work.program.systems[derived];
    for (Node& node : side.setting.value.nodes) {
        const auto* item = node.as<ItemId>();
        const auto* definition = node.as<DefinitionId>();
        if (item == nullptr && definition == nullptr) continue;
        const std::string_view name =
            item != nullptr ? from.item_name(*item) : from.definitions[*definition].name;
        const Meaning* own = find(work.names[derived], name);
        if (own == nullptr || own->has_error) continue;
        if (own->is_definition()) {
            node.kind = std::get<DefinitionId>(own->id);
        } else {
            node.kind = own->item();
        }
    }
    return is_known_along_side(work, system, side.setting.value);
}

}  // namespace

bool is_side_word(std::string_view word) { return is_setting_of(SettingBlock::side, word); }

void check_system_sides(Workspace& work, const ast::Script& script, const ast::Block& block,
                        SystemId index, std::optional<SystemId> base) {
    // A system with errors is not added if its base is unknown.
    if (index == unknown_system) return;
    Scope scope;
    scope.system = index;
    System& system = work.draft->systems[index];
    std::vector<SubjectSide> own = read_side_rules(work, script, scope, block.sides);
    if (base && *base != unknown_system) {
        const System& from = work.program.systems[*base];
        for (SubjectSide side : from.sides) {
            const auto* item = std::get_if<ItemId>(&side.subject);
            const auto subject =
                find_subject(work, index,
                             item != nullptr
                                 ? from.item_name(*item)
                                 : from.definitions[std::get<DefinitionId>(side.subject)].name);
            const bool is_replaced = std::ranges::any_of(own, [&](const SubjectSide& rule) {
                return rule.subject == subject && rule.side == side.side;
            });
            if (!subject || is_replaced) continue;
            side.subject = *subject;
            if (!take_over(work, from, index, side)) break;
            mark_reads(work, side.setting.value, index);
            system.sides.push_back(std::move(side));
        }
    }
    std::ranges::move(own, std::back_inserter(system.sides));
}

void check_domain_side(Workspace& work, const ast::Script& script,
                       const ast::Statement& statement) {
    const auto written = read_side(work, script, statement);
    if (!written) return;
    SideSetting setting{written->kind, {}, statement.span};
    if (written->value) {
        const auto value = check_constant(work, script, *written->value,
                                          "the value of a side of all species", std::nullopt);
        // If the value has an error, the error has been reported. The kind of the rule still
        // applies.
        setting.value = {{Node{value.value_or(0), statement.span}}};
    }
    const bool is_for_all = statement.name.text == "sides";
    for (const Side side : sides_of_word(statement.name.text)) {
        auto& target = work.draft->domain.sides[static_cast<std::size_t>(side)];
        if (!is_for_all || !target) target = setting;
    }
}

void check_stage_sides(Workspace& work, const ast::Script& script) {
    SideSettings domain = sides_of_domain(work.program.domain);
    if (!are_pairs(work, domain)) return;
    const SideOverrides overrides = distribute_side_overrides(work, script);
    std::uint32_t index = 0;
    for (const ast::Block& block : script.blocks) {
        const bool is_stage =
            block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
        if (!is_stage) continue;
        Stage& stage = work.draft->stages[index];
        Scope scope;
        scope.system = stage.system;
        scope.stage = scope.last_stage = index;
        ++index;
        if (stage.system == unknown_system) continue;
        std::vector<SubjectSide> rules = read_side_rules(work, script, scope, block.sides);
        // Overrides are applied last, so that they replace other rules. The last override has
        // priority.
        for (const ast::Statement& change : overrides[index - 1]) {
            for (SubjectSide& rule : read_side_rules(work, script, scope, std::span(&change, 1))) {
                rules.push_back(std::move(rule));
            }
        }
        resolve(work, stage, rules);
    }
}

}  // namespace cascade::checking
