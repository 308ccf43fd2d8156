// Checks the settings iterations, interval, frozen, speed and show of systems and stages.
// check_time.cpp checks the settings of time.
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_time.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::checking {
namespace {

/// Whether `speed` is set to a word that means automatic steps in other programs and that this
/// script does not declare.
bool asks_for_automatic(const Workspace& work, const ast::Script& script,
                        const ast::Statement& speed, const Scope& scope) {
    static constexpr std::array<std::string_view, 9> words = {"automatic", "adaptive", "dynamic",
                                                              "variable",  "fast",     "fastest",
                                                              "slow",      "max",      "default"};
    const auto* const name = std::get_if<ast::Name>(&script.expressions[speed.values[0].root].node);
    if (name == nullptr || std::ranges::find(words, name->name) == words.end()) return false;
    const bool has_names = scope.system < work.names.next();
    return !has_names || find(work.names[scope.system], name->name) == nullptr;
}

void report_unknown_species(Workspace& work, Span span, std::string_view name,
                            const System& system) {
    std::vector<std::string> known;
    for (const Quantity& each : system.quantities) {
        if (each.is_species) known.push_back(each.name);
    }
    std::string hint = did_you_mean(work, name, known);
    if (hint.empty()) hint = "its species are " + list_names(known);
    work.diagnostics.error(span, fmt::format("'{}' is not a species of {}", name, system.name),
                           std::move(hint));
}

/// The species that growth does not dilute. Reports names that are not species.
std::vector<ItemId> read_undiluted(Workspace& work, const ast::Script& script,
                                   const ast::Statement& statement, const Scope& scope) {
    std::vector<ItemId> species;
    Scope names;
    names.context = Context::rate;
    names.system = scope.system;
    const System& system = work.program.systems[scope.system];
    for (const ast::Expression value : statement.values) {
        const auto* const name = std::get_if<ast::Name>(&script.expressions[value.root].node);
        if (name != nullptr && find(work.names[scope.system], name->name) == nullptr) {
            report_unknown_species(work, span_of(script, value), name->name, system);
            continue;
        }
        const auto checked = check_expression(work, script, value, names);
        if (!checked) continue;
        const Node& node = checked->formula.nodes.back();
        const auto* const item = node.as<ItemId>();
        if (item != nullptr && system.is_species(*item)) {
            species.push_back(*item);
            continue;
        }
        work.diagnostics.error(span_of(script, value), "'undiluted' takes only names of species",
                               "write undiluted: u, v, for example");
    }
    return species;
}

std::optional<Formula> read_shown(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement, const Scope& scope) {
    Scope picture = scope;
    picture.context = Context::picture;
    picture.last_stage = scope.stage.value_or(0);
    auto checked = check_expression(work, script, statement.values[0], picture);
    if (!checked) return std::nullopt;
    if (checked->type() == ValueType::number || checked->type() == ValueType::colour)
        return std::move(checked->formula);
    const TypeWords words = words_of(checked->type(), is_of_cells(work, scope));
    work.diagnostics.error(span_of(script, statement.values[0]),
                           fmt::format("{} cannot be shown", words.name), std::string(words.hint));
    return std::nullopt;
}

std::optional<Formula> read_speed(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement, const Scope& scope) {
    const Span span = span_of(script, statement.values[0]);
    if (asks_for_automatic(work, script, statement, scope)) {
        work.diagnostics.error(span, "'speed' must be auto or the length of a step",
                               "write 'speed: auto'");
        return std::nullopt;
    }
    auto checked = check_number(work, script, statement.values[0], scope);
    if (!checked) return std::nullopt;
    if (checked->constant && !(*checked->constant > 0)) {
        work.diagnostics.error(span, "speed must be above 0");
        return std::nullopt;
    }
    return std::move(checked->formula);
}

}  // namespace

void check_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                   const Scope& scope, Settings& settings) {
    if (statement.name.text == "undiluted") {
        settings.undiluted = read_undiluted(work, script, statement, scope);
        return;
    }
    if (!has_one_value(work, script, statement)) return;
    const std::string_view name = statement.name.text;
    const Setting setting = *setting_named(name);
    const bool is_speed = setting == Setting::speed && !is_automatic(script, statement);
    const bool has_cells = is_of_cells(work, scope);
    if (has_cells && is_speed) {
        work.diagnostics.error(statement.name.span,
                               "'speed' cannot be set for cells that crawl, "
                               "because their solver chooses the length of "
                               "steps",
                               "leave 'speed' out; 'largest_step' limits the length of steps");
        return;
    }
    if (has_cells && setting == Setting::start) {
        work.diagnostics.error(statement.name.span,
                               "cells that crawl cannot run on a coarser grid");
        return;
    }
    if (setting == Setting::iterations) {
        put(settings.iterations, read_number(work, script, statement));
    } else if (setting == Setting::interval) {
        put(settings.interval, read_number(work, script, statement));
    } else if (setting == Setting::show) {
        if (auto shown = read_shown(work, script, statement, scope))
            settings.show = std::move(*shown);
    } else if (is_speed) {
        auto speed = read_speed(work, script, statement, scope);
        if (!speed) return;
        settings.speed = std::move(*speed);
        settings.time.automatic_speed = false;
    } else if (setting == Setting::frozen) {
        if (auto checked = check_number(work, script, statement.values[0], scope))
            settings.frozen = std::move(checked->formula);
    } else {
        check_time_setting(work, script, statement, scope, settings);
    }
    const bool observes = setting == Setting::interval || setting == Setting::every;
    if (observes && settings.interval && settings.time.every) {
        work.diagnostics.error(
            statement.name.span,
            "'interval' and 'every' cannot be used together: one counts steps, the other time",
            "leave one of them out");
    }
    if (!has_cells && is_end_setting(name) && settings.time.duration && settings.iterations) {
        work.diagnostics.error(statement.name.span,
                               "'iterations' and 'duration' cannot be used together",
                               "leave one of them out");
    }
}

}  // namespace cascade::checking
