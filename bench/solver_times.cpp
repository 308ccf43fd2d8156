// cascade_solver_times: how long each solver takes to an equally good pattern, and how good it is.
//
// usage: cascade_solver_times [--threads=N] [SIDE…]      256 and 1024 without a side
//
// Every solver of the language grows the same spots from the same noise for the same time, as
// `cascade run --solver NAME` does. Beside Euler's pattern stand the correlation with it, the
// wavelength and the number of spots: a solver that is fast and has another pattern shows. Quiet
// machines only; the time is that on the wall, kernels compiled within it.
#include "core/floating_point.h"
#include "ir/solver.h"
#include "measure/features.h"
#include "run/measured.h"
#include "run/script.h"
#include "run/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::bench {
namespace {

struct Pattern {
    const char* name;
    const char* text;
};

/// Turk's spots with the two sizes of his leopard: reaction limits the step of the first less.
constexpr Pattern patterns[] = {
    {"large spots", "stage s: turing_spots { iterations: 28000; ka: 0.05/16 }\n"},
    {"small spots", "stage s: turing_spots { iterations: 7000; ka: 0.2/16 }\n"},
};

struct Outcome {
    double seconds = 0;
    std::int64_t steps = 0;
    double t = 0;
    measure::Features features;
    Field field;
};

/// Empty, with a line on stderr, where the solver does not take this pattern.
std::optional<Outcome> grow(const Pattern& pattern, const std::string& solver, std::int64_t side,
                            int threads) {
    Overrides changes;
    changes.grid = GridSize{side, side};
    changes.solver = solver;
    Script script = load_script(pattern.name, pattern.text, ".", std::move(changes));
    const auto refused = [&](const std::string& why) {
        std::fprintf(stderr, "%s does not grow %s: %s\n", solver.c_str(), pattern.name,
                     why.c_str());
        return std::nullopt;
    };
    if (!script.program) return refused(script.messages(false));
    SimulationOptions options;
    options.threads = threads;
    auto simulation = Simulation::create(script, options);
    if (!simulation) return refused(simulation.error().message);
    if (auto started = (*simulation)->start_stage(0); !started) {
        return refused(started.error().message);
    }
    const std::int64_t most = script.program->stages[0].iterations;
    RunControl control;
    const auto before = std::chrono::steady_clock::now();
    const auto end = (*simulation)->advance_stage(0, most, control, {});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
    if (!end) return refused(end.error().message);
    const StageState& state = (*simulation)->state(0);
    Outcome outcome;
    outcome.seconds = took.count();
    outcome.steps = state.steps;
    outcome.t = state.t;
    outcome.field = state.species.back().clone();
    outcome.features = measure::measure(to_samples(outcome.field, (*simulation)->grid()));
    return outcome;
}

/// Of two fields over their cells: 1 for the same pattern, 0 for two that have nothing in common.
double correlation(const Field& a, const Field& b) {
    const FieldMoments of_a = moments(a), of_b = moments(b);
    const FieldMoments apart = moments_of_difference(a, b);
    // var(a − b) = var(a) + var(b) − 2 cov(a, b)
    const double covariance = (of_a.deviation * of_a.deviation + of_b.deviation * of_b.deviation -
                               apart.deviation * apart.deviation) / 2;
    return covariance / (of_a.deviation * of_b.deviation);
}

void compare(const Pattern& pattern, std::int64_t side, int threads) {
    fmt::print("\n{}, {} × {}\n{:<12}{:>8}{:>9}{:>10}{:>9}{:>13}{:>12}{:>8}\n", pattern.name, side,
               side, "solver", "steps", "t", "seconds", "Euler's", "correlation", "wavelength",
               "spots");
    const std::optional<Outcome> euler = grow(pattern, "euler", side, threads);
    if (!euler) std::exit(1);
    for (const std::string& solver : solver_names()) {
        const std::optional<Outcome> found =
            solver == "euler" ? std::nullopt : grow(pattern, solver, side, threads);
        if (!found && solver != "euler") continue;
        const Outcome& it = found ? *found : *euler;
        // Spots of b are where it is low.
        fmt::print("{:<12}{:>8}{:>9.0f}{:>10.2f}{:>9.2f}{:>13.4f}{:>12.2f}{:>8.0f}\n", solver,
                   it.steps, it.t, it.seconds, it.seconds / euler->seconds,
                   correlation(it.field, euler->field), it.features.wavelength, it.features.holes);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    const cascade::FlushDenormals environment;
    int threads = 1;
    std::vector<std::int64_t> sides;
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k];
        const bool is_threads = word.starts_with("--threads=");
        const long number = std::atol(argv[k] + (is_threads ? 10 : 0));
        if (number < 1 || number > 16384) {
            std::fprintf(stderr, "usage: cascade_solver_times [--threads=N] [SIDE...]\n");
            return 64;
        }
        if (is_threads) {
            threads = static_cast<int>(number);
        } else {
            sides.push_back(number);
        }
    }
    if (sides.empty()) sides = {256, 1024};
    for (const auto& pattern : cascade::bench::patterns) {
        for (const std::int64_t side : sides) cascade::bench::compare(pattern, side, threads);
    }
}
