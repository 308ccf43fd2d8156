// The analysis of a stage before it runs: its flat states, the waves that grow from each of them,
// and the longest steps with which all other waves fade.
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
    /// The largest stable step in the unit of time of the rates. Infinite if nothing fades; 0 if no
    /// step is stable.
    double step = 0;
};

/// The largest stable steps of euler, rk2, rk4, rk23 and rk45, from the polynomial by which each
/// solver multiplies a wave in a step (E. Hairer, G. Wanner, "Solving Ordinary Differential
/// Equations II", 1996, section IV.2). `rates` are eigenvalues whose real parts are at most 0.
std::vector<StableStep> stable_steps(std::span<const Complex> rates);

struct StateAnalysis {
    FlatState state;
    Matrices matrices;
    Dispersion relation;
    std::vector<StableStep> steps;
};

struct StageAnalysis {
    LinearModel model;
    /// The flat states. If Newton's method finds one from the starting values, it is the first.
    std::vector<StateAnalysis> states;
    /// Whether the reaction conserves totals, so that flat states come in families.
    bool has_conserved_totals = false;
    Vector start;                ///< The starting values of the species.
    std::optional<double> step;  ///< The time step, if it is the same in all cells and fixed.
};

/// The length of the stage's steps. Empty if this length differs between cells or is adapted during
/// the stage.
std::optional<double> fixed_step(const LinearModel& model);

/// Analyses a stage. Fails if linear_model() fails. The program must outlive the result.
Result<StageAnalysis> analyze_stage(const Program& program, std::uint32_t stage);

/// The most interesting state: the first state from which waves grow although it is stable against
/// uniform changes or, if there is none, the first of all states. There must be at least one state.
const StateAnalysis& state_to_show(const StageAnalysis& analysis);

/// A text such as "u = 1, v = 0.9". Names at most six species.
std::string values_text(const LinearModel& model, const Vector& species);

/// The analysis as a text of a few lines.
std::string describe(const StageAnalysis& analysis);

/// The name of the class for users, such as "Turing".
std::string_view name_of(Stability stability);

}  // namespace cascade::analysis
