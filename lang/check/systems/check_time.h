// The settings of time (internal to the checker): solver, tolerance, duration, until, check, start
// and `speed: auto`. spec/time.md defines them.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"

#include <cstdint>
#include <string_view>

namespace cascade::checking {

/// The most steps a stage may take.
inline constexpr std::int64_t most_iterations = 1'000'000'000;

/// True for `speed: auto`.
bool is_automatic(const ast::Script& script, const ast::Statement& speed);

/// True for `iterations` and `duration`: a stage ends by one of them, and overriding either
/// replaces both.
bool is_end_setting(std::string_view name);

/// Applies a setting of time. The statement has one value.
void check_time_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope, Settings& settings);

/// Fills in the settings of time of a stage: its own ones, then its system's, then the language's
/// defaults.
void fill_time(Stage& stage, const Settings& own, const Settings& defaults);

/// Gives the stage the solver of `asked` (`--solver`) and keeps its duration, which is iterations ·
/// speed if it has none. Stabilised and semi-implicit solvers choose their steps as with `speed:
/// auto`.
void change_solver(Stage& stage, const TimeSettings& asked);

/// Reports errors that involve several settings of a stage: incompatible ones, a speed or a
/// condition that varies by cell where it must not.
void check_time(Workspace& work, std::uint32_t stage);

}  // namespace cascade::checking
