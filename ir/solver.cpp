// Properties of the solvers.
#include "ir/solver.h"

#include "core/check.h"

#include <algorithm>
#include <array>

namespace cascade {
namespace {

struct Row {
    std::string_view name;
    int order;
    double interval;  ///< Stable on the negative real axis up to this. 0 if the chosen number of
                      ///< stages decides it.
};

/// In the order of Solver. Semi-implicit solvers have the interval of their explicit part: two of
/// them are Euler's method without diffusion, etdrk4 is the classical method of fourth order. ros2
/// is Heun's method without a reaction, and a decaying reaction never shortens its interval. The
/// intervals are the zeros of |R(z)| = 1 on the negative axis, where R is the stability polynomial
/// (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 1996, section IV.2). For
/// Dormand-Prince, R belongs to the formula of fifth order.
constexpr std::array<Row, 12> rows{{{"euler", 1, 2.0},
                                    {"symplectic", 1, 2.0},
                                    {"rk2", 2, 2.0},
                                    {"rk4", 4, 2.785},
                                    {"rk23", 3, 2.512},
                                    {"rk45", 5, 3.306},
                                    {"rkl1", 1, 0},
                                    {"rkl2", 2, 0},
                                    {"imex", 1, 2.0},
                                    {"etdrk4", 4, 2.785},
                                    {"gauss", 1, 2.0},
                                    {"ros2", 2, 2.0}}};

const Row& row(Solver solver) { return rows[static_cast<std::size_t>(solver)]; }

}  // namespace

std::string_view name_of(Solver solver) { return row(solver).name; }

std::optional<Solver> solver_of(std::string_view name) {
    if (name == "imex2") return Solver::etdrk4;
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.name == name; });
    if (found == rows.end()) return std::nullopt;
    return static_cast<Solver>(found - rows.begin());
}

std::vector<std::string> solver_names() {
    std::vector<std::string> names;
    for (const Row& each : rows) names.emplace_back(each.name);
    return names;
}

bool is_adaptive(Solver solver) { return solver == Solver::rk23 || solver == Solver::rk45; }
bool is_stabilised(Solver solver) { return solver == Solver::rkl1 || solver == Solver::rkl2; }
bool is_semi_implicit(Solver solver) {
    return solver == Solver::imex || solver == Solver::etdrk4 || solver == Solver::gauss;
}
bool is_locally_implicit(Solver solver) { return solver == Solver::ros2; }
bool takes_speed_by_cell(Solver solver) {
    return solver == Solver::euler || solver == Solver::symplectic;
}
int order_of(Solver solver) { return row(solver).order; }

int order_of_estimate(Solver solver) {
    if (is_adaptive(solver)) return order_of(solver);
    if (is_locally_implicit(solver)) return 2;  // The embedded method is of first order.
    return std::min(order_of(solver) + 1, 3);
}

/// Meyer, Balsara and Aslam 2014, equations 15 and 24: (s² + s) / 2 and (s² + s − 2) / 4 Euler
/// steps, each of which is stable down to −2.
double stability_interval(Solver solver, std::uint32_t stages) {
    const double s = stages;
    if (solver == Solver::rkl1) return s * s + s;
    if (solver == Solver::rkl2) return (s * s + s - 2) / 2;
    return row(solver).interval;
}

std::uint32_t least_stages(Solver solver) { return solver == Solver::rkl1 ? 1 : 3; }

std::uint32_t stages_for(Solver solver, double ratio) {
    CHECK(is_stabilised(solver), "only stabilised solvers choose their stages");
    std::uint32_t stages = least_stages(solver);
    // The negation makes NaN continue to the end.
    while (stages < most_stages && !(stability_interval(solver, stages) >= 2 * ratio)) stages += 2;
    return stages;
}

}  // namespace cascade
