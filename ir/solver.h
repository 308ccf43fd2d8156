// The solvers of the language and their properties.
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
    etdrk4,
    gauss,
    ros2
};

std::string_view name_of(Solver solver);
/// The solver of that name. `imex2`, which `etdrk4` replaced, is another name for it.
std::optional<Solver> solver_of(std::string_view name);
std::vector<std::string> solver_names();

/// Whether it chooses its steps by an error estimate.
bool is_adaptive(Solver solver);
/// Whether it takes more stages for longer steps (Runge-Kutta-Legendre).
bool is_stabilised(Solver solver);
/// Whether it takes diffusion implicitly or exactly, and only the rest by its rate at the old step.
bool is_semi_implicit(Solver solver);
/// Whether it takes the reaction in each cell implicitly, and diffusion by its rate.
bool is_locally_implicit(Solver solver);
/// Whether some part of the rates never limits steps by its stability.
inline bool is_partly_implicit(Solver solver) {
    return is_semi_implicit(solver) || is_locally_implicit(solver);
}
/// Whether its steps may be many times as long as explicit Euler's: as long as the reaction allows,
/// however fast diffusion is, or the other way round.
inline bool takes_long_steps(Solver solver) {
    return is_stabilised(solver) || is_partly_implicit(solver);
}
/// Whether the time step may vary by cell.
bool takes_speed_by_cell(Solver solver);
/// The order p: the error of a whole run is proportional to step^p.
int order_of(Solver solver);
/// The p for which the estimated error of a step is proportional to step^p: by the embedded pair of
/// an adaptive solver or of `ros2`, for others as in solvers/error_estimate.h.
int order_of_estimate(Solver solver);
/// The solver is stable if −λ · step is below this for every negative eigenvalue λ of the rates'
/// Jacobian, or of its explicit part. `stages` is for stabilised solvers.
double stability_interval(Solver solver, std::uint32_t stages = 1);

/// The smallest odd number of stages with which a stabilised solver is stable for steps `ratio`
/// times as long as explicit Euler's longest; `most_stages` if there is none.
std::uint32_t stages_for(Solver solver, double ratio);
/// The smallest number of stages of a stabilised solver: `rkl1` with one stage is explicit Euler.
std::uint32_t least_stages(Solver solver);
inline constexpr std::uint32_t most_stages = 99;

}  // namespace cascade
