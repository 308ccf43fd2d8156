// The settings of time (internal to the checker): solver, tolerance, duration, until, check, start
// and `speed: auto`. spec/time.md defines them.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"

#include <cstdint>
#include <string_view>

namespace cascade::checking {

/// The largest number of steps in a stage.
inline constexpr std::int64_t most_iterations = 1'000'000'000;

/// Whether the statement is `speed: auto`.
bool is_automatic(const ast::Script& script, const ast::Statement& speed);

/// Whether the setting is `iterations` or `duration`. A stage has only one of these, so an override
/// of either replaces both.
bool is_end_setting(std::string_view name);

/// Applies a setting of time. The statement must have one value.
void check_time_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope, Settings& settings);

/// Fills in the settings of time of a stage from its own settings, then from the settings of its
/// system, and then from the defaults of the language.
void fill_time(Stage& stage, const Settings& own, const Settings& defaults);

/// Gives the stage the solver of the option --solver (`asked`). The duration stays the same. If the
/// stage has no duration, it becomes iterations · speed. Stabilised and semi-implicit solvers
/// choose their steps as with `speed: auto`.
void change_solver(Stage& stage, const TimeSettings& asked);

/// Reports errors that involve several settings of a stage: settings that exclude each other, and a
/// speed or condition that varies by cell where this is not allowed.
void check_time(Workspace& work, std::uint32_t stage);

}  // namespace cascade::checking
