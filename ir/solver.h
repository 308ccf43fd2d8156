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

/// What a solver needs and promises, as bits.
enum class SolverTrait : std::uint8_t {
    none = 0,
    speed_by_cell = 1 << 0,     ///< The time step may vary by cell.
    in_turn = 1 << 1,           ///< Species are changed one after the other.
    adaptive = 1 << 2,          ///< It chooses its steps by an error estimate.
    stabilised = 1 << 3,        ///< It takes more stages for longer steps (Runge-Kutta-Legendre).
    semi_implicit = 1 << 4,     ///< It takes diffusion implicitly or exactly, and only the rest by
                                ///< its rate at the old step.
    locally_implicit = 1 << 5,  ///< It takes the reaction in each cell implicitly, and diffusion by
                                ///< its rate.
};
bool has(Solver solver, SolverTrait trait);

std::string_view name_of(Solver solver);
/// `imex2`, which `etdrk4` replaced, is another name of it.
std::optional<Solver> solver_of(std::string_view name);
std::vector<std::string> solver_names();

inline bool is_adaptive(Solver solver) { return has(solver, SolverTrait::adaptive); }
inline bool is_stabilised(Solver solver) { return has(solver, SolverTrait::stabilised); }
inline bool is_semi_implicit(Solver solver) { return has(solver, SolverTrait::semi_implicit); }
inline bool is_locally_implicit(Solver solver) {
    return has(solver, SolverTrait::locally_implicit);
}
/// Whether a part of the rates limits no step by its stability.
inline bool is_partly_implicit(Solver solver) {
    return is_semi_implicit(solver) || is_locally_implicit(solver);
}
/// Whether its steps may be many times as long as those of explicit Euler: as long as the reaction
/// allows, however fast diffusion is, or the other way round.
inline bool takes_long_steps(Solver solver) {
    return is_stabilised(solver) || is_partly_implicit(solver);
}
inline bool takes_speed_by_cell(Solver solver) { return has(solver, SolverTrait::speed_by_cell); }
inline bool changes_in_turn(Solver solver) { return has(solver, SolverTrait::in_turn); }
/// The order p: the error of a whole run is proportional to step^p.
int order_of(Solver solver);
/// The p for which the estimated error of a step is proportional to step^p: the embedded pair of an
/// adaptive solver or of `ros2`, for others as in solvers/error_estimate.h.
int order_of_estimate(Solver solver);
/// The solver is stable if −λ · step is below this for every negative eigenvalue λ of the rates'
/// Jacobian, or of the part that is taken explicitly. `stages` is that of a stabilised solver.
double stability_interval(Solver solver, std::uint32_t stages = 1);

/// The smallest odd number of stages with which a stabilised solver is stable for steps `ratio`
/// times as long as the longest of explicit Euler; `most_stages` if there is none.
std::uint32_t stages_for(Solver solver, double ratio);
/// The smallest number of stages of a stabilised solver: `rkl1` with one stage is explicit Euler.
std::uint32_t least_stages(Solver solver);
inline constexpr std::uint32_t most_stages = 99;

}  // namespace cascade
