// cascade_solver_times: how long each solver takes to grow a pattern, and how good the
// pattern is.
//
// usage: cascade_solver_times [--threads=N] [--solver=NAME…] [--pattern=NAME…] [--tolerance=E]
//                             [SIDE…]
//        by default all solvers, large and small spots, 256 and 1024
//
// Every solver of the language grows the same pattern from the same noise for the same time, as
// `cascade run --solver NAME` does. Each pattern is compared with Euler's by correlation,
// wavelength and number of spots, so that a fast solver with another pattern is noticed. Needs an
// idle machine. Times are wall times and include compiling.
//
// For comparison, straight C++ (straight_cpp.h) takes Euler's steps on one thread. All its steps
// take the same time, so only some are taken and their time is multiplied.
#include "bench/cascade_side.h"
#include "bench/straight_side.h"
#include "core/floating_point.h"
#include "ir/solver.h"
#include "jit/jit.h"
#include "measure/features.h"
#include "run/pictures/measured.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::bench {
namespace {

struct Pattern {
    const char* name;
    const char* text;
    StraightStep StraightSteps::*straight;  ///< The step in straight C++.
    const char* varying;                    ///< The parameter that varies by cell, or empty.
};

/// Turk's spots in the two sizes of his leopard, then larger spots, because the reaction limits the
/// step less if spots are larger. Then two systems with lap of lap.
constexpr Pattern known_patterns[] = {
    {"large", "stage s: turing_spots { iterations: 28000; ka: 0.05/16 }\n",
     &StraightSteps::turing_without_mask, "beta"},
    {"small", "stage s: turing_spots { iterations: 7000; ka: 0.2/16 }\n",
     &StraightSteps::turing_without_mask, "beta"},
    {"larger", "stage s: turing_spots { iterations: 56000; ka: 0.05/32 }\n",
     &StraightSteps::turing_without_mask, "beta"},
    {"largest", "stage s: turing_spots { iterations: 112000; ka: 0.05/64 }\n",
     &StraightSteps::turing_without_mask, "beta"},
    {"mixture", "stage s: cahn_hilliard { iterations: 12000 }\n", &StraightSteps::cahn_hilliard,
     ""},
    {"rolls", "stage s: swift_hohenberg { iterations: 5000 }\n", &StraightSteps::swift_hohenberg,
     ""},
};

struct Choice {
    std::vector<std::string> solvers = solver_names();
    std::vector<std::string> patterns = {"large", "small"};
    std::vector<std::int64_t> sides = {256, 1024};
    int threads = 1;
    /// The tolerance of all solvers but Euler's method. If empty, the default.
    std::string tolerance;
};

struct Outcome {
    double seconds = 0;
    std::int64_t steps = 0;
    double t = 0;
    measure::Features features;
    Field field;
};

std::string text_of(const Pattern& pattern, std::int64_t side) {
    return fmt::format("domain {{ grid: {}, {} }}\n{}", side, side, pattern.text);
}

/// The text with one more setting in its stage.
std::string with_setting(std::string text, const std::string& setting) {
    if (!setting.empty()) text.insert(text.rfind('}'), "; " + setting + " ");
    return text;
}

double seconds_since(std::chrono::steady_clock::time_point before) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

/// Grows a pattern. If the solver does not support it, prints a line on stderr and returns nothing.
std::optional<Outcome> grow(const Pattern& pattern, const std::string& solver, std::int64_t side,
                            const Choice& choice) {
    Overrides changes;
    changes.solver = solver;
    Script script = load_script(pattern.name,
                                with_setting(text_of(pattern, side),
                                             solver == "euler" ? std::string() : choice.tolerance),
                                ".", std::move(changes));
    const auto refused = [&](const std::string& why) {
        std::fprintf(stderr, "%s does not grow %s: %s\n", solver.c_str(), pattern.name,
                     why.c_str());
        return std::nullopt;
    };
    if (!script.program) return refused(script.messages(false));
    SimulationOptions options;
    options.threads = choice.threads;
    auto simulation = Simulation::create(script, options);
    if (!simulation) return refused(simulation.error().message);
    if (auto started = (*simulation)->start_stage(0); !started) {
        return refused(started.error().message);
    }
    const std::int64_t most = script.program->stages[0].iterations;
    RunControl control;
    const auto before = std::chrono::steady_clock::now();
    const auto end = (*simulation)->advance_stage(0, most, control, {});
    const double took = seconds_since(before);
    if (!end) return refused(end.error().message);
    const StageState& state = (*simulation)->state(0);
    Outcome outcome;
    outcome.seconds = took;
    outcome.steps = state.steps;
    outcome.t = state.t;
    outcome.field = state.species().back().clone();
    outcome.features =
        measure::measure(measure::to_samples(outcome.field, (*simulation)->domain().grid));
    return outcome;
}

/// The correlation of two fields over their cells: 1 for the same pattern, 0 for unrelated ones.
double correlation(const Field& a, const Field& b) {
    const FieldMoments of_a = moments(a), of_b = moments(b);
    const FieldMoments apart = moments_of_difference(a, b);
    // var(a − b) = var(a) + var(b) − 2 cov(a, b)
    const double covariance = (of_a.deviation * of_a.deviation + of_b.deviation * of_b.deviation -
                               apart.deviation * apart.deviation) /
                              2;
    return covariance / (of_a.deviation * of_b.deviation);
}

/// Euler's steps in straight C++, with the fastest of the three sets of compiler flags.
class StraightEuler {
public:
    StraightEuler(const Pattern& pattern, std::int64_t side, Backend& backend)
        : side_(CascadeSide(text_of(pattern, side), backend), pattern.varying),
          step_(pattern.straight) {
        // `steps_` becomes the number of steps that take a tenth of a second, but at least 4.
        side_.advance(straight_wide().*step_, 4);
        const double four = time(straight_wide(), 4);
        steps_ = std::max<std::int64_t>(4, static_cast<std::int64_t>(0.4 / four));
    }

    /// Measures each set of flags three times. The fastest of all measurements counts.
    void look() {
        for (int repetition = 0; repetition < 3; ++repetition) {
            for (const StraightSteps& steps :
                 {straight_contracted(), straight_wide(), straight_strict()}) {
                const double each = time(steps, steps_) / static_cast<double>(steps_);
                least_ = least_ > 0 ? std::min(least_, each) : each;
            }
        }
    }
    double seconds_of_step() const { return least_; }

private:
    double time(const StraightSteps& steps, std::int64_t count) {
        const auto before = std::chrono::steady_clock::now();
        side_.advance(steps.*step_, count);
        return seconds_since(before);
    }

    StraightSide side_;
    StraightStep StraightSteps::*step_;
    std::int64_t steps_ = 0;
    double least_ = 0;
};

void compare(const Pattern& pattern, std::int64_t side, const Choice& choice, Backend& backend) {
    fmt::print("\n{}, {} × {}\n{:<14}{:>8}{:>9}{:>10}{:>9}{:>8}{:>13}{:>12}{:>8}\n", pattern.name,
               side, side, "solver", "steps", "t", "seconds", "Euler's", "C++'s", "correlation",
               "wavelength", "spots");
    StraightEuler straight(pattern, side, backend);
    straight.look();
    std::vector<std::pair<std::string, Outcome>> all;
    const auto add = [&](const std::string& solver) {
        std::optional<Outcome> found = grow(pattern, solver, side, choice);
        if (found) all.emplace_back(solver, std::move(*found));
        straight.look();
    };
    add("euler");
    if (all.empty()) std::exit(1);
    for (const std::string& solver : choice.solvers) {
        if (solver != "euler") add(solver);
    }
    const Outcome& euler = all.front().second;
    const double of_straight = straight.seconds_of_step() * static_cast<double>(euler.steps);
    fmt::print("{:<14}{:>8}{:>9.0f}{:>10.2f}{:>9.2f}{:>8.2f}\n", "straight C++", euler.steps,
               euler.t, of_straight, of_straight / euler.seconds, 1.0);
    for (const auto& [solver, it] : all) {
        // Spots of b are where b is low.
        fmt::print("{:<14}{:>8}{:>9.0f}{:>10.2f}{:>9.2f}{:>8.3f}{:>13.4f}{:>12.2f}{:>8.0f}\n",
                   solver, it.steps, it.t, it.seconds, it.seconds / euler.seconds,
                   it.seconds / of_straight, correlation(it.field, euler.field),
                   it.features.wavelength, it.features.holes);
    }
    std::fflush(stdout);
}

/// Reads the command line. Returns nothing if a word is not in the usage.
std::optional<Choice> read_choice(int argc, char** argv) {
    Choice choice;
    std::vector<std::string> solvers, patterns;
    std::vector<std::int64_t> sides;
    const auto number_in = [](std::string_view word) { return std::atol(word.data()); };
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k];
        if (word.starts_with("--solver=")) {
            solvers.emplace_back(word.substr(9));
            if (!solver_of(solvers.back())) return std::nullopt;
        } else if (word.starts_with("--pattern=")) {
            patterns.emplace_back(word.substr(10));
            const bool is_known = std::any_of(std::begin(known_patterns), std::end(known_patterns),
                                              [&](const Pattern& pattern) {
                                                  return pattern.name == patterns.back();
                                              });
            if (!is_known) return std::nullopt;
        } else if (word.starts_with("--tolerance=")) {
            choice.tolerance = fmt::format("tolerance: {}", word.substr(12));
        } else {
            const bool is_threads = word.starts_with("--threads=");
            const long number = number_in(is_threads ? word.substr(10) : word);
            if (number < 1 || number > 16384) return std::nullopt;
            if (is_threads) choice.threads = static_cast<int>(number);
            else sides.push_back(number);
        }
    }
    if (!solvers.empty()) choice.solvers = solvers;
    if (!patterns.empty()) choice.patterns = patterns;
    if (!sides.empty()) choice.sides = sides;
    return choice;
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    using namespace cascade::bench;
    const cascade::FlushDenormals environment;
    const std::optional<Choice> choice = read_choice(argc, argv);
    if (!choice) {
        std::fprintf(stderr,
                     "usage: cascade_solver_times [--threads=N] [--solver=NAME...] "
                     "[--pattern=small|large|larger|largest|mixture|rolls...] "
                     "[--tolerance=E] [SIDE...]\n");
        return 64;
    }
    const auto backend = cascade::make_jit();
    if (!backend) {
        std::fprintf(stderr, "cascade_solver_times: %s\n", backend.error().message.c_str());
        return 1;
    }
    for (const Pattern& pattern : known_patterns) {
        const auto& wanted = choice->patterns;
        if (std::find(wanted.begin(), wanted.end(), pattern.name) == wanted.end()) continue;
        for (const std::int64_t side : choice->sides) compare(pattern, side, *choice, **backend);
    }
}
