// The properties of each solver.
#include "ir/solver.h"

#include "core/check.h"

#include <algorithm>
#include <iterator>

namespace cascade {
namespace {

struct Row {
    std::string_view name;
    int order;
    double interval;
    SolverTrait traits;
};

constexpr SolverTrait operator|(SolverTrait a, SolverTrait b) {
    return static_cast<SolverTrait>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

using enum SolverTrait;
constexpr Row rows[] = {
#define CASCADE_SOLVER(name, order, interval, traits) {#name, order, interval, traits},
#include "ir/solvers.def"
};

const Row& row(Solver solver) { return rows[static_cast<std::size_t>(solver)]; }

}  // namespace

std::string_view name_of(Solver solver) { return row(solver).name; }

std::optional<Solver> solver_of(std::string_view name) {
    if (name == "imex2") return Solver::etdrk4;
    const auto found = std::ranges::find(rows, name, &Row::name);
    if (found == std::end(rows)) return std::nullopt;
    return static_cast<Solver>(found - std::begin(rows));
}

std::vector<std::string> solver_names() {
    std::vector<std::string> names;
    for (const Row& each : rows) names.emplace_back(each.name);
    return names;
}

bool has(Solver solver, SolverTrait trait) {
    return (static_cast<unsigned>(row(solver).traits) & static_cast<unsigned>(trait)) != 0;
}

int order_of(Solver solver) { return row(solver).order; }

int order_of_estimate(Solver solver) {
    if (is_adaptive(solver)) return order_of(solver);
    // The method embedded in a locally implicit solver has order 1.
    if (is_locally_implicit(solver)) return 2;
    return std::min(order_of(solver) + 1, 3);
}

/// With s stages, rkl1 takes (s² + s) / 2 and rkl2 takes (s² + s − 2) / 4 steps of Euler at once.
/// Each Euler step is stable for λ · step down to −2 (Meyer, Balsara and Aslam 2014, equations 15
/// and 24).
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
    // The negated comparison makes the loop end with the largest number of stages if `ratio` is
    // NaN.
    while (stages < most_stages && !(stability_interval(solver, stages) >= 2 * ratio)) stages += 2;
    return stages;
}

}  // namespace cascade
