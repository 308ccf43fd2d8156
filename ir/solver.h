// The solvers of the language and their properties (ir/solvers.def).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The values of the setting `solver`.
enum class Solver : std::uint8_t {
#define CASCADE_SOLVER(name, ...) name,
#include "ir/solvers.def"
};

/// The properties of a solver, as bits.
enum class SolverTrait : std::uint8_t {
    none = 0,
    speed_by_cell = 1 << 0,  ///< The time step may vary by cell.
    in_turn = 1 << 1,        ///< Species are changed one after the other.
    adaptive = 1 << 2,       ///< The solver chooses its steps by an error estimate.
    stabilised = 1 << 3,  ///< The solver uses more stages for longer steps (Runge-Kutta-Legendre).
    /// The solver treats diffusion implicitly or exactly, and all other terms by their rates at the
    /// old step.
    semi_implicit = 1 << 4,
    /// The solver treats the reaction in each cell implicitly, and diffusion explicitly.
    locally_implicit = 1 << 5,
};
bool has(Solver solver, SolverTrait trait);

std::string_view name_of(Solver solver);
/// The solver of this name; nullopt if there is none. `imex2`, which no longer exists, gives its
/// successor `etdrk4`.
std::optional<Solver> solver_of(std::string_view name);
std::vector<std::string> solver_names();

inline bool is_adaptive(Solver solver) { return has(solver, SolverTrait::adaptive); }
inline bool is_stabilised(Solver solver) { return has(solver, SolverTrait::stabilised); }
inline bool is_semi_implicit(Solver solver) { return has(solver, SolverTrait::semi_implicit); }
inline bool is_locally_implicit(Solver solver) {
    return has(solver, SolverTrait::locally_implicit);
}
/// Whether the solver treats some terms of the rates implicitly, so that they do not limit the
/// step.
inline bool is_partly_implicit(Solver solver) {
    return is_semi_implicit(solver) || is_locally_implicit(solver);
}
/// Whether steps may be many times as long as steps of explicit Euler, because diffusion or the
/// reaction does not limit them.
inline bool takes_long_steps(Solver solver) {
    return is_stabilised(solver) || is_partly_implicit(solver);
}
inline bool takes_speed_by_cell(Solver solver) { return has(solver, SolverTrait::speed_by_cell); }
inline bool changes_in_turn(Solver solver) { return has(solver, SolverTrait::in_turn); }
/// The order p: the error of a whole run is proportional to (step length)^p.
int order_of(Solver solver);
/// The p for which the estimated error of one step is proportional to (step length)^p. Adaptive
/// solvers and `ros2` take the estimate from their embedded pair. For other solvers, see
/// solvers/error_estimate.h.
int order_of_estimate(Solver solver);
/// The solver is stable if −λ · step is below this number for every negative eigenvalue λ of the
/// Jacobian of the rates. If the solver treats a part of the rates implicitly, only the Jacobian of
/// the explicit part counts. `stages` is the number of stages of a stabilised solver.
double stability_interval(Solver solver, std::uint32_t stages = 1);

/// The smallest odd number of stages with which a stabilised solver can take stable steps `ratio`
/// times as long as explicit Euler. At most `most_stages`.
std::uint32_t stages_for(Solver solver, double ratio);
/// The smallest number of stages of a stabilised solver: 1 for `rkl1`, which with one stage is
/// explicit Euler, and 3 for `rkl2`.
std::uint32_t least_stages(Solver solver);
inline constexpr std::uint32_t most_stages = 99;

}  // namespace cascade
