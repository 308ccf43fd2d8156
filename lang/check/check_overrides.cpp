// Overrides from outside the script: options, and the stages that each --set applies to.
#include "lang/check/check_blocks.h"
#include "lang/check/user_functions.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

const ast::Statement* value_statement(const ast::Statement& statement) {
    const bool usable = statement.kind == ast::StatementKind::value && !statement.name.empty() &&
                        !statement.values.empty();
    return usable ? &statement : nullptr;
}

const ast::Statement* constant_statement(const ast::Override& change) {
    const ast::Statement& statement = change.statement;
    const bool is_plain = change.stage.empty() && statement.side.empty() && statement.index.empty();
    return is_plain ? value_statement(statement) : nullptr;
}

const ast::Statement* find_option(const ast::Script& script, std::string_view name) {
    const auto found =
        std::find_if(script.options.begin(), script.options.end(),
                     [&](const ast::Statement& option) { return option.name.text == name; });
    return found == script.options.end() ? nullptr : &*found;
}

namespace {

bool is_of_constant(Workspace& work, const ast::Script& script, const ast::Override& change) {
    const ast::Statement* statement = constant_statement(change);
    return statement != nullptr &&
           functions_of(work, script).find_constant(statement->name.text) != nullptr;
}

/// True if the statement can set something in this stage.
bool has_name(const Workspace& work, const Stage& stage, const ast::Statement& statement) {
    if (stage.system == unknown_system) return true;
    const std::string_view name = statement.name.text;
    if (!statement.index.empty()) return has_family(work.program.systems[stage.system], name);
    if (reserved(name) != Reserved::no) return true;
    const bool has_cells = work.program.systems[stage.system].cells.has_value();
    if (is_setting_of(has_cells ? SettingBlock::cell_stage : SettingBlock::field_stage, name)) {
        return true;
    }
    return find(work.names[stage.system], name) != nullptr;
}

void report_unknown_override(Workspace& work, const ast::Word& name) {
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
    diagnostic.hint = hint_about(work, name.text, WordContext::stage, names);
    work.diagnostics.add(std::move(diagnostic));
}

void report_unknown_stage(Workspace& work, const ast::Word& name) {
    std::vector<std::string> names;
    for (const Stage& stage : work.program.stages) names.push_back(stage.name);
    work.diagnostics.error(name.span, fmt::format("there is no stage '{}'", name.text),
                           did_you_mean(work, name.text, names));
}

/// `--set gray_scott.feed=…` with the name of a system, not of a stage: sets it in all its stages.
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

/// True if the stage has a species or a definition, or a family of them, with the statement's name.
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

/// An override of a side; `stage` is empty if it applies to all stages with the species.
struct SideChange {
    ast::Word stage;
    ast::Statement statement;
};

/// The override as one of a side, if it is one: u.left is if no stage and no system is called u.
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
            // If a stage that was named lacks the species, that is reported with its other sides.
            if (side->stage.empty() ? !has_subject(work, stage, statement) : !is_named) continue;
            result[k].push_back(statement);
            is_used = true;
        }
        if (is_used) continue;
        if (!side->stage.empty() && !is_stage) {
            report_unknown_stage(work, side->stage);
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
        if (is_of_constant(work, script, change)) continue;
        if (!change.stage.empty()) {
            const auto found = work.stages.find(std::string(change.stage.text));
            if (found != work.stages.end()) {
                result[found->second].push_back(statement);
                continue;
            }
            if (set_in_stages_of_system(work, change.stage.text, statement, result)) continue;
            report_unknown_stage(work, change.stage);
            continue;
        }
        bool used = false;
        for (std::size_t i = 0; i < result.size(); ++i) {
            if (!has_name(work, work.program.stages[i], *statement)) continue;
            result[i].push_back(statement);
            used = true;
        }
        if (!used) report_unknown_override(work, statement->name);
    }
    return result;
}

}  // namespace cascade::checking
