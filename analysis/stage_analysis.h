// The analysis of a stage before it runs: its flat states, the waves that grow from each of them,
// and the stable steps for the others.
#pragma once

#include "analysis/dispersion.h"
#include "analysis/flat_states.h"
#include "analysis/wave_operators.h"
#include "core/result.h"
#include "ir/solver.h"

#include <span>
#include <string>
#include <vector>

namespace cascade::analysis {

struct StableStep {
    Solver solver = Solver::euler;
    double step = 0;  ///< In the time of the rates. Infinite if nothing fades, 0 if no step is.
};

/// For euler, rk2, rk4, rk23 and rk45, by the polynomial with which each multiplies a wave in a
/// step (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 1996, section IV.2).
/// `rates` are eigenvalues whose real part is not above 0.
std::vector<StableStep> stable_steps(std::span<const Complex> rates);

struct StateAnalysis {
    FlatState state;
    Matrices matrices;
    Dispersion relation;
    std::vector<StableStep> steps;
};

struct StageAnalysis {
    LinearModel model;
    std::vector<StateAnalysis> states;  ///< The starting values' state first, if it exists.
    bool has_conserved_totals = false;  ///< Flat states then come in families.
    Vector start;                       ///< The starting values of the species.
    std::optional<double> step;         ///< The time step, if it is one number.
};

/// The length of the stage's steps, if it is the same in all cells and not chosen by the stage.
std::optional<double> fixed_step(const LinearModel& model);

/// Fails where linear_model() does. The program must outlive the result.
Result<StageAnalysis> analyze_stage(const Program& program, std::uint32_t stage);

/// The most interesting state: the first that is stable without waves and from which waves grow, or
/// else the first. There must be one.
const StateAnalysis& state_to_show(const StageAnalysis& analysis);

/// "u = 1, v = 0.9", at most six of them.
std::string values_text(const LinearModel& model, const Vector& species);

/// The analysis as a text of a few lines.
std::string describe(const StageAnalysis& analysis);

/// The classes in words, such as "Turing".
std::string_view name_of(Stability stability);

}  // namespace cascade::analysis
