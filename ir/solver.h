// The solvers of the language: what is known of each by its name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The values of the setting `solver`.
enum class Solver : std::uint8_t {
    euler,
    symplectic,
    rk2,
    rk4,
    rk23,
    rk45,
    rkl1,
    rkl2,
    imex,
    imex2,
    gauss
};

std::string_view name_of(Solver solver);
std::optional<Solver> solver_of(std::string_view name);
std::vector<std::string> solver_names();

/// Does it choose its steps by an estimate of the error?
bool is_adaptive(Solver solver);
/// Does it take more stages the longer the step is (Runge-Kutta-Legendre)?
bool is_stabilised(Solver solver);
/// Does it take diffusion implicitly or exactly, and only the rest by its rate at the old step?
bool is_semi_implicit(Solver solver);
/// Are its steps as long as the reaction allows, however fast diffusion is?
inline bool takes_long_steps(Solver solver) {
    return is_stabilised(solver) || is_semi_implicit(solver);
}
/// May the time step vary by cell?
bool takes_speed_by_cell(Solver solver);
/// Its order: the error of a whole run is proportional to step^order.
int order_of(Solver solver);
/// The error of a step that is estimated is proportional to step^this: of an adaptive solver by its
/// embedded pair, of the others as in solvers/error_estimate.h.
int order_of_estimate(Solver solver);
/// −λ · step must be below this for every negative eigenvalue λ of the rates. `stages` counts those
/// of a stabilised solver.
double stability_interval(Solver solver, std::uint32_t stages = 1);

/// The least odd number of stages with which a stabilised solver is stable for steps `ratio` times
/// as long as the longest of explicit Euler; `most_stages` where none is.
std::uint32_t stages_for(Solver solver, double ratio);
/// The fewest stages of a stabilised solver: `rkl1` of one stage is explicit Euler.
std::uint32_t least_stages(Solver solver);
inline constexpr std::uint32_t most_stages = 99;

}  // namespace cascade
