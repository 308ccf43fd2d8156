// Compares the throughput of native code with straight C++.
#include "bench/comparison.h"

#include "bench/cascade_side.h"
#include "bench/medians.h"
#include "bench/straight_cpp.h"
#include "bench/straight_side.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

struct System {
    std::string name;
    std::string (*text)(const GridSize& grid);
    std::string varying;
    StraightStep StraightSteps::*step;
    int dimensions = 2;
    std::vector<std::int64_t> sides = {64, 256, 512, 2048};

    GridSize grid(std::int64_t side) const { return {side, side, dimensions == 3 ? side : 1}; }
};

std::vector<System> systems() {
    const std::vector<std::int64_t> up_to_huge = {64, 256, 512, 2048, 8192}, in_space = {128, 256};
    return {{"turing", turing_text, "beta", &StraightSteps::turing, 2, up_to_huge},
            {"gray_scott", gray_scott_text, "", &StraightSteps::gray_scott, 2, up_to_huge},
            {"stripes", stripes_text, "ai", &StraightSteps::stripes},
            {"cahn_hilliard", cahn_hilliard_text, "", &StraightSteps::cahn_hilliard},
            {"chemotaxis", chemotaxis_text, "", &StraightSteps::chemotaxis},
            {"tensor", tensor_text, "", &StraightSteps::tensor},
            {"allen_cahn", allen_cahn_text, "", &StraightSteps::allen_cahn},
            {"three_species", rock_scissors_paper_text, "", &StraightSteps::rock_scissors_paper},
            {"perona_malik", perona_malik_text, "", &StraightSteps::perona_malik},
            {"turing_3d", turing_text, "beta", &StraightSteps::turing_in_space, 3, in_space},
            {"gray_scott_3d", gray_scott_text, "", &StraightSteps::gray_scott_in_space, 3,
             in_space}};
}

/// Both sides of the comparison, for one system at one size.
struct Contest {
    Contest(const System& system, std::int64_t side, Backend& backend)
        : steps(steps_between_looks(system.grid(side))),
          ours(system.text(system.grid(side)), backend),
          fast(system.text(system.grid(side)), backend, Rounding::fast),
          theirs(ours, system.varying) {}
    std::int64_t steps;
    CascadeSide ours, fast;
    StraightSide theirs;
};

/// Ends the program if the sides compute different values, because then the comparison would be
/// worthless.
void check_agreement(Backend& backend) {
    for (const System& system : systems()) {
        for (const StraightSteps& steps :
             {straight_contracted(), straight_wide(), straight_strict()}) {
            Contest contest(system, system.dimensions == 3 ? 32 : 64, backend);
            contest.theirs.advance(steps.*system.step, 100);
            for (CascadeSide* side : {&contest.ours, &contest.fast}) {
                side->advance(100);
                const double difference =
                    largest_difference(side->species(), contest.theirs.species());
                if (difference < 1e-4) continue;
                std::fprintf(stderr, "cascade_bench: %s differs from straight C++ by %g\n",
                             system.name.c_str(), difference);
                std::exit(1);
            }
        }
    }
}

std::string title(const System& system, std::int64_t side, const std::string& who) {
    return fmt::format("{}/{}/{}", system.name, side, who);
}

/// Measures both sides in turns. Each side is made when it is first needed and freed after the
/// comparison, because large grids take much memory.
void run_contest(Backend& backend, const System& system, std::int64_t side, Medians& times) {
    std::unique_ptr<Contest> contest;
    const auto add = [&](const std::string& who, auto advance) {
        benchmark::RegisterBenchmark(title(system, side, who).c_str(),
                                     [&, advance](benchmark::State& state) {
                                         if (!contest)
                                             contest =
                                                 std::make_unique<Contest>(system, side, backend);
                                         for (auto _ : state) advance(*contest);
                                     })
            ->Unit(benchmark::kMicrosecond);
    };
    add("jit", [](Contest& it) { it.ours.advance(it.steps); });
    add("fast", [](Contest& it) { it.fast.advance(it.steps); });
    const auto straight = [&](const std::string& who, const StraightSteps& steps) {
        add(who, [step = steps.*system.step](Contest& it) { it.theirs.advance(step, it.steps); });
    };
    straight("g++", straight_contracted());
    straight("g++ 512", straight_wide());
    straight("g++ strict", straight_strict());
    benchmark::RunSpecifiedBenchmarks(&times);
    benchmark::ClearRegisteredBenchmarks();
}

void print_table(Medians& times) {
    fmt::print(
        "\nMillions of cell steps a second, medians; in brackets our speed over theirs, with "
        "--fast "
        "after that of 'jit'.\n"
        "{:<14}{:>6}{:>9}{:>9}{:>21}{:>21}{:>16}\n",
        "system", "side", "jit", "fast", "g++", "g++ 512", "g++ strict");
    for (const System& system : systems()) {
        for (const std::int64_t side : system.sides) {
            const double ours = times.median(title(system, side, "jit"));
            const double fast = times.median(title(system, side, "fast"));
            if (ours <= 0 || fast <= 0) continue;
            const GridSize grid = system.grid(side);
            const auto cells = static_cast<double>(cell_count(grid) * steps_between_looks(grid));
            std::string line = fmt::format("{:<14}{:>6}{:>9.0f}{:>9.0f}", system.name, side,
                                           cells / ours * 1e-6, cells / fast * 1e-6);
            for (const char* who : {"g++", "g++ 512"}) {
                const double theirs = times.median(title(system, side, who));
                line += theirs > 0 ? fmt::format("{:>9.0f} ({:.2f} {:.2f})", cells / theirs * 1e-6,
                                                 theirs / ours, theirs / fast)
                                   : fmt::format("{:>21}", "-");
            }
            const double strict = times.median(title(system, side, "g++ strict"));
            line += strict > 0
                        ? fmt::format("{:>9.0f} ({:.2f})", cells / strict * 1e-6, strict / ours)
                        : fmt::format("{:>16}", "-");
            fmt::print("{}\n", line);
        }
    }
}

}  // namespace

void compare_throughput(Backend& backend) {
    check_agreement(backend);
    Medians times;
    for (const System& system : systems()) {
        for (const std::int64_t side : system.sides) run_contest(backend, system, side, times);
    }
    print_table(times);
}

}  // namespace cascade::bench
