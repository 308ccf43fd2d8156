// The settings of time (internal to the checker): solver, tolerance, duration, until, check and
// `speed: auto`; `start` is kept for later. What they mean is in spec/time.md.
#pragma once

#include "lang/check/check_expression.h"
#include "lang/check/check_names.h"

#include <cstdint>
#include <string_view>

namespace cascade::checking {

/// The most steps a stage may take.
inline constexpr std::int64_t most_iterations = 1'000'000'000;

/// Is this `speed: auto`?
bool is_automatic(const ast::Script& script, const ast::Statement& speed);

/// `iterations` and `duration`: a stage ends by one of them, and what replaces either replaces
/// both.
bool is_end_setting(std::string_view name);

/// Sets it. The statement has one value.
void check_time_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope, Settings& settings);

/// Iterations, interval and all of time of a stage: its own settings, then its system's, then the
/// language's.
void fill_time(Stage& stage, const Settings& own, const Settings& defaults);

/// The stage takes the solver of `asked` (`--solver`) and keeps the time it takes: iterations ·
/// speed where it has no duration. Stabilised and semi-implicit solvers choose their steps as with
/// `speed: auto`.
void change_solver(Stage& stage, const TimeSettings& asked);

/// Faults that only show when the whole stage is known: settings that do not go together, a speed
/// that varies where it must not, a condition that varies by cell.
void check_time(Workspace& work, std::uint32_t stage);

/// Stages that start on coarser grids need a flat grid, all of whose sides can be halved so often.
void check_coarse_starts(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
