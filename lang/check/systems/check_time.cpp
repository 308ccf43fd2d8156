// Checks each setting of time separately. check_stage_time.cpp checks whether the settings are
// compatible.
#include "lang/check/systems/check_time.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_coarse.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/expressions/setting_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade::checking {

namespace {

const ast::Expr& root_of(const ast::Script& script, ast::Expression expression) {
    return script.expressions[expression.root];
}

/// The name of which the expression consists; "" if the expression is not a single name.
std::string_view word_of(const ast::Script& script, ast::Expression expression) {
    const auto* name = std::get_if<ast::Name>(&root_of(script, expression).node);
    return name == nullptr ? std::string_view() : name->name;
}

/// The call of `name` of which the expression consists; else null.
const ast::Call* call_of(const ast::Script& script, ast::Expression expression,
                         std::string_view name) {
    const auto* call = std::get_if<ast::Call>(&root_of(script, expression).node);
    return call != nullptr && call->function.text == name ? call : nullptr;
}

/// The argument of a call with one argument. The nodes of the argument come before the call.
ast::Expression argument_of(const ast::Script& script, ast::Expression expression,
                            const ast::Call& call) {
    return {expression.first, script.arguments[call.first_argument]};
}

void check_solver(Workspace& work, const ast::Script& script, ast::Expression value,
                  TimeSettings& time) {
    const std::string_view word = word_of(script, value);
    const Span span = root_of(script, value).span;
    if (word.empty()) {
        if (std::holds_alternative<ast::Garbage>(root_of(script, value).node)) return;
        const auto* const text = std::get_if<ast::Text>(&root_of(script, value).node);
        work.diagnostics.error(span, "'solver' takes one word",
                               text != nullptr && solver_of(text->value)
                                   ? fmt::format("write {} without quotes", text->value)
                                   : fmt::format("solvers are {}", list_names(solver_names())));
        return;
    }
    time.solver = solver_of(word);
    time.solver_span = span;
    if (time.solver) return;
    std::string hint = did_you_mean(work, word, solver_names());
    for (const std::string_view part : {"implicit", "crank", "backward", "bdf", "cn"}) {
        if (word.starts_with(part)) hint = "imex and ros2 are implicit: write 'solver: imex'";
    }
    if (hint.empty()) hint = fmt::format("solvers are {}", list_names(solver_names()));
    work.diagnostics.error(span, fmt::format("there is no solver '{}'", word), std::move(hint));
}

void check_until(Workspace& work, const ast::Script& script, ast::Expression value,
                 const Scope& scope, TimeSettings& time) {
    if (const ast::Call* call = call_of(script, value, "steady")) {
        if (call->argument_count != 1) {
            work.diagnostics.error(
                root_of(script, value).span,
                "steady takes one number, the largest change that still counts as steady",
                "write steady(0.01), for example");
            return;
        }
        const ast::Expression change = argument_of(script, value, *call);
        const auto largest = check_constant(work, script, change, "steady");
        if (largest && !(*largest >= 1e-6 && *largest <= 0.9)) {
            work.diagnostics.error(root_of(script, change).span,
                                   "steady must be from 1e-06 to 0.9");
            return;
        }
        time.steady = largest;
        return;
    }
    // A condition reads the present values of the stage that it ends, as a picture does.
    Scope present = scope;
    present.context = Context::picture;
    present.last_stage = scope.stage.value_or(0);
    auto checked = check_number(work, script, value, present);
    if (!checked) return;
    if (std::ranges::all_of(checked->formula.nodes, &Node::is<double>)) {
        work.diagnostics.error(root_of(script, value).span,
                               "'until' needs a condition that changes during the run, but this "
                               "value is always the same",
                               "write 'until: t > 100', or 'duration: 100'");
        return;
    }
    time.until = std::move(checked->formula);
}

}  // namespace

bool is_automatic(const ast::Script& script, const ast::Statement& speed) {
    return word_of(script, speed.values[0]) == "auto";
}

bool is_end_setting(std::string_view name) { return name == "iterations" || name == "duration"; }

void check_time_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope, Settings& settings) {
    const std::string_view name = statement.name.text;
    const ast::Expression value = statement.values[0];
    TimeSettings& time = settings.time;
    if (name == "speed") {
        time.automatic_speed = true;
        settings.speed = Formula{{Node{1.0, root_of(script, value).span}}};
    } else if (name == "solver") {
        check_solver(work, script, value, time);
    } else if (name == "tolerance") {
        put(time.tolerance, read_number(work, script, statement));
    } else if (name == "largest_step") {
        put(time.largest_step, read_number(work, script, statement));
        time.largest_step_span = statement.name.span;
    } else if (name == "every") {
        put(time.every, read_number(work, script, statement));
        time.every_span = statement.name.span;
    } else if (name == "duration") {
        put(time.duration, read_number(work, script, statement));
    } else if (name == "check") {
        put(time.check, read_number(work, script, statement));
    } else if (name == "until") {
        check_until(work, script, value, scope, time);
    } else {
        const auto coarse = check_coarse(work, script, value, "start",
                                         "'start' takes coarse(N), to begin in cells N times as "
                                         "wide");
        if (!coarse) return;
        time.coarse = coarse->times;
        time.coarse_span = coarse->span;
    }
}

}  // namespace cascade::checking
