// Checks overrides, which are options from outside the script, and finds the stages to which each
// --set applies.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

bool is_of_domain(const ast::Script& script, const ast::Override& change) {
    const ast::Statement& statement = change.statement;
    const std::string_view name = statement.name.text;
    const bool is_length = name == "extent" || name == "spacing";
    if (!is_length || !statement.side.empty() || !statement.index.empty()) return false;
    if (!change.stage.empty()) return change.stage.text == "domain";
    return std::ranges::none_of(script.blocks, [&](const ast::Block& block) {
        return block.kind != ast::BlockKind::domain &&
               std::ranges::any_of(block.statements, [&](const ast::Statement& each) {
                   return each.name.text == name;
               });
    });
}

namespace {

/// The command-line option that changes this setting of the domain. Empty if there is none.
std::string option_for(const ast::Script& script, std::string_view name,
                       const ast::Statement& statement) {
    if (name == "grid") {
        const auto* const number =
            std::get_if<ast::Number>(&script.expressions[statement.values[0].root].node);
        const auto side = number != nullptr ? static_cast<std::int64_t>(number->value) : 64;
        return fmt::format("the option --grid {0}x{0} sets it", side);
    }
    for (const std::string_view each : {"seed", "precision", "cells", "mesh", "up", "facing"}) {
        if (name == each) return fmt::format("the option --{} sets it", each);
    }
    if (name == "surface") return "the option --mesh sets it, as in --mesh sphere";
    const bool is_of_domain = is_setting_of(SettingBlock::domain, name) || is_side_word(name);
    return is_of_domain ? "change it in the script: --set can change only 'extent' and 'spacing' "
                          "of the domain"
                        : "";
}

bool is_of_constant(Workspace& work, const ast::Script& script, const ast::Override& change) {
    const ast::Statement* statement = constant_statement(change);
    return statement != nullptr &&
           functions_of(work, script).find_constant(statement->name.text) != nullptr;
}

/// Whether the statement can set a value in this stage.
bool has_name(const Workspace& work, const Stage& stage, const ast::Statement& statement) {
    if (stage.system == unknown_system) return true;
    const std::string_view name = statement.name.text;
    if (!statement.index.empty()) return has_family(work.program.systems[stage.system], name);
    if (reserved(name) != Reserved::no) return true;
    const bool has_cells = work.program.systems[stage.system].cells.has_value();
    if (is_setting_of(has_cells ? SettingBlock::cell_stage : SettingBlock::field_stage, name) ||
        name == "size") {
        return true;
    }
    return find(work.names[stage.system], name) != nullptr;
}

void report_unknown_override(Workspace& work, const ast::Script& script,
                             const ast::Statement& statement) {
    const ast::Word& name = statement.name;
    std::vector<std::string> names;
    for (const Stage& stage : work.program.stages) {
        if (stage.system == unknown_system) continue;
        for (std::string& each : quantity_names(work.program.systems[stage.system])) {
            names.push_back(std::move(each));
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    Diagnostic diagnostic;
    diagnostic.span = name.span;
    diagnostic.message = fmt::format("no stage has a parameter '{}'", name.text);
    if (!names.empty()) {
        diagnostic.notes.push_back({std::nullopt, "there are " + list_names(names)});
    }
    for (std::string& each : settings_of({SettingBlock::stage, SettingBlock::field_stage}))
        names.push_back(std::move(each));
    diagnostic.hint = option_for(script, name.text, statement);
    if (diagnostic.hint.empty()) {
        diagnostic.hint = with_number(hint_about(work, name.text, WordContext::stage, names),
                                      script.expressions[statement.values[0].root]);
    } else {
        diagnostic.message = fmt::format("'{}' is a setting of the domain", name.text);
        diagnostic.notes.clear();
    }
    work.diagnostics.add(std::move(diagnostic));
}

void report_unknown_stage(Workspace& work, const ast::Script& script, const ast::Word& name,
                          const ast::Statement& statement) {
    if (name.text == "domain") {
        const std::string hint = option_for(script, statement.name.text, statement);
        const auto message =
            hint.empty() ? fmt::format("the domain has no setting '{}'", statement.name.text)
                         : fmt::format("'{}' is a setting of the domain", statement.name.text);
        return work.diagnostics.error(join(name.span, statement.name.span), message, hint);
    }
    if (name.text == "picture") {
        return work.diagnostics.error(name.span, "settings of the picture cannot be changed here",
                                      "use --show, --palette or --range");
    }
    std::vector<std::string> names;
    for (const Stage& stage : work.program.stages) names.push_back(stage.name);
    std::string hint = did_you_mean(work, name.text, names);
    for (std::size_t k = 0; k < names.size() && hint.empty(); ++k) {
        if (!has_name(work, work.program.stages[k], statement)) continue;
        hint = fmt::format("write {}.{}", names[k], statement.name.text);
    }
    if (hint.empty() && !names.empty()) hint = "stages are " + list_names(names);
    work.diagnostics.error(name.span, fmt::format("there is no stage '{}'", name.text),
                           std::move(hint));
}

/// Applies an override that names a system and not a stage, such as `--set gray_scott.feed=…`, to
/// all stages of the system.
bool set_in_stages_of_system(const Workspace& work, std::string_view system,
                             const ast::Statement* statement, StageOverrides& result) {
    bool used = false;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const SystemId its = work.program.stages[i].system;
        if (its == unknown_system || work.program.systems[its].name != system) continue;
        result[i].push_back(statement);
        used = true;
    }
    return used;
}

bool is_system(const Workspace& work, std::string_view name) {
    return std::any_of(work.program.systems.begin(), work.program.systems.end(),
                       [&](const System& system) { return system.name == name; });
}

/// Whether the stage has a species, a definition or a family with the name that the statement sets.
bool has_subject(const Workspace& work, const Stage& stage, const ast::Statement& statement) {
    if (stage.system == unknown_system) return false;
    const System& system = work.program.systems[stage.system];
    const std::string name = statement.index.empty() ? std::string(statement.name.text)
                                                     : fmt::format("{}[", statement.name.text);
    const auto is_named = [&](const std::string& each) {
        return statement.index.empty() ? each == name : each.starts_with(name);
    };
    return std::ranges::any_of(system.quantities,
                               [&](const Quantity& quantity) {
                                   return quantity.is_species && is_named(quantity.name);
                               }) ||
           std::ranges::any_of(system.definitions, [&](const Definition& definition) {
               return is_named(definition.name);
           });
}

/// An override of a rule at a side. `stage` is empty if the override applies to all stages that
/// have the species.
struct SideChange {
    ast::Word stage;
    ast::Statement statement;
};

/// The change as an override of a rule at a side; nullopt if it is not such an override. `u.left`
/// means a side of u if no stage and no system is called u.
std::optional<SideChange> as_side(const Workspace& work, const ast::Override& change) {
    if (!change.statement.side.empty()) return SideChange{change.stage, change.statement};
    const bool may_be = !change.stage.empty() && change.statement.index.empty() &&
                        is_side_word(change.statement.name.text) &&
                        !work.stages.contains(std::string(change.stage.text)) &&
                        !is_system(work, change.stage.text);
    if (!may_be) return std::nullopt;
    SideChange side{{}, change.statement};
    side.statement.side = side.statement.name;
    side.statement.name = change.stage;
    const bool has_sides =
        std::any_of(work.program.stages.begin(), work.program.stages.end(),
                    [&](const Stage& stage) { return has_subject(work, stage, side.statement); });
    return has_sides ? std::optional(std::move(side)) : std::nullopt;
}

void report_no_side(Workspace& work, const ast::Word& word) {
    work.diagnostics.error(word.span, fmt::format("'{}' is not a side of the grid", word.text),
                           did_you_mean(work, word.text, settings_of({SettingBlock::side})));
}

}  // namespace

SideOverrides distribute_side_overrides(Workspace& work, const ast::Script& script) {
    SideOverrides result(work.program.stages.size());
    for (const ast::Override& change : script.overrides) {
        if (value_statement(change.statement) == nullptr) continue;
        const auto side = as_side(work, change);
        if (!side) continue;
        const ast::Statement& statement = side->statement;
        if (!is_side_word(statement.side.text)) {
            report_no_side(work, statement.side);
            continue;
        }
        bool is_stage = false, is_used = false;
        for (std::size_t k = 0; k < result.size(); ++k) {
            const Stage& stage = work.program.stages[k];
            const bool is_its_system = stage.system != unknown_system &&
                                       !work.stages.contains(std::string(side->stage.text)) &&
                                       work.program.systems[stage.system].name == side->stage.text;
            const bool is_named = stage.name == side->stage.text || is_its_system;
            is_stage |= is_named;
            // If the override names a stage without this species, the error is reported later, when
            // the sides of the stage are checked.
            if (side->stage.empty() ? !has_subject(work, stage, statement) : !is_named) continue;
            result[k].push_back(statement);
            is_used = true;
        }
        if (is_used) continue;
        if (!side->stage.empty() && !is_stage) {
            report_unknown_stage(work, script, side->stage, statement);
        } else {
            work.diagnostics.error(statement.name.span,
                                   fmt::format("no stage has a species '{}'", statement.name.text));
        }
    }
    return result;
}

StageOverrides distribute_overrides(Workspace& work, const ast::Script& script) {
    StageOverrides result(work.program.stages.size());
    for (const ast::Override& change : script.overrides) {
        const ast::Statement* statement = value_statement(change.statement);
        if (statement == nullptr || as_side(work, change)) continue;
        if (is_of_constant(work, script, change) || is_of_domain(script, change)) continue;
        const bool is_grid =
            statement->name.text == "grid" &&
            !std::holds_alternative<ast::Call>(script.expressions[statement->values[0].root].node);
        if (change.stage.empty() && is_grid) {
            report_unknown_override(work, script, *statement);
            continue;
        }
        if (!change.stage.empty()) {
            const auto found = work.stages.find(std::string(change.stage.text));
            if (found != work.stages.end()) {
                result[found->second].push_back(statement);
                continue;
            }
            if (set_in_stages_of_system(work, change.stage.text, statement, result)) continue;
            report_unknown_stage(work, script, change.stage, *statement);
            continue;
        }
        bool used = false;
        for (std::size_t i = 0; i < result.size(); ++i) {
            if (!has_name(work, work.program.stages[i], *statement)) continue;
            result[i].push_back(statement);
            used = true;
        }
        if (!used) report_unknown_override(work, script, *statement);
    }
    return result;
}

}  // namespace cascade::checking
