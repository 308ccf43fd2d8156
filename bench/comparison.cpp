// Throughput of native code against straight C++.
#include "bench/comparison.h"

#include "bench/cascade_side.h"
#include "bench/straight_cpp.h"
#include "bench/straight_side.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

constexpr std::int64_t steps_between_looks = 64;  // As Schedule::check_every has it.
constexpr std::array<std::int64_t, 4> sides = {64, 256, 512, 2048};

struct System {
    std::string name;
    std::string (*text)(std::int64_t side);
    std::string varying;
    StraightStep StraightSteps::*step;
};

std::vector<System> systems() {
    return {{"turing", turing_text, "beta", &StraightSteps::turing},
            {"gray_scott", gray_scott_text, "", &StraightSteps::gray_scott},
            {"stripes", stripes_text, "ai", &StraightSteps::stripes},
            {"cahn_hilliard", cahn_hilliard_text, "", &StraightSteps::cahn_hilliard},
            {"chemotaxis", chemotaxis_text, "", &StraightSteps::chemotaxis},
            {"tensor", tensor_text, "", &StraightSteps::tensor},
            {"allen_cahn", allen_cahn_text, "", &StraightSteps::allen_cahn},
            {"three_species", rock_scissors_paper_text, "", &StraightSteps::rock_scissors_paper},
            {"perona_malik", perona_malik_text, "", &StraightSteps::perona_malik}};
}

/// One system at one size, on both sides. Made when first needed: the large ones take memory.
struct Contest {
    Contest(const System& system, std::int64_t side, Backend& backend)
        : ours(system.text(side), backend), theirs(ours, system.varying) {}
    CascadeSide ours;
    StraightSide theirs;
};

class Contests {
public:
    explicit Contests(Backend& backend) : backend_(backend) {}
    Contest& get(const System& system, std::int64_t side) {
        auto& contest = made_[{system.name, side}];
        if (!contest) contest = std::make_unique<Contest>(system, side, backend_);
        return *contest;
    }

private:
    Backend& backend_;
    std::map<std::pair<std::string, std::int64_t>, std::unique_ptr<Contest>> made_;
};

double largest_difference(std::span<const Field> a, std::span<const Field> b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        for (std::int64_t j = 0; j < a[k].layout().height; ++j) {
            for (std::int64_t i = 0; i < a[k].layout().width; ++i) {
                const double difference = std::abs(double{a[k].at(i, j)} - b[k].at(i, j));
                largest = std::max(largest, std::isnan(difference) ? INFINITY : difference);
            }
        }
    }
    return largest;
}

/// A contest between different computations would be worth nothing.
void check_agreement(Backend& backend) {
    for (const System& system : systems()) {
        for (const StraightSteps& steps :
             {straight_contracted(), straight_wide(), straight_strict()}) {
            Contest contest(system, 64, backend);
            contest.ours.advance(100);
            contest.theirs.advance(steps.*system.step, 100);
            const double difference =
                largest_difference(contest.ours.species(), contest.theirs.species());
            if (difference < 1e-4) continue;
            std::fprintf(stderr, "cascade_bench: %s differs from straight C++ by %g\n",
                         system.name.c_str(), difference);
            std::exit(1);
        }
    }
}

/// Keeps every repetition's time; prints nothing until all are there.
class Collector : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            seconds_[run.run_name.function_name].push_back(
                run.cpu_accumulated_time /
                static_cast<double>(run.iterations * steps_between_looks));
        }
    }
    /// Median of seconds per step; 0 where the benchmark was filtered out.
    double median(const std::string& name) {
        std::vector<double>& times = seconds_[name];
        if (times.empty()) return 0;
        std::sort(times.begin(), times.end());
        const std::size_t half = times.size() / 2;
        return times.size() % 2 ? times[half] : (times[half - 1] + times[half]) / 2;
    }

private:
    std::map<std::string, std::vector<double>> seconds_;
};

std::string title(const System& system, std::int64_t side, const std::string& who) {
    return fmt::format("{}/{}/{}", system.name, side, who);
}

void register_contest(Contests& contests, const System& system, std::int64_t side) {
    const auto add = [&](const std::string& who, auto advance) {
        benchmark::RegisterBenchmark(
            title(system, side, who).c_str(),
            [&contests, system, side, advance](benchmark::State& state) {
                Contest& contest = contests.get(system, side);
                for (auto _ : state) advance(contest);
            })
            ->Unit(benchmark::kMicrosecond);
    };
    add("jit", [](Contest& contest) { contest.ours.advance(steps_between_looks); });
    const auto straight = [&](const std::string& who, const StraightSteps& steps) {
        add(who, [step = steps.*system.step](Contest& contest) {
            contest.theirs.advance(step, steps_between_looks);
        });
    };
    straight("g++", straight_contracted());
    straight("g++ 512", straight_wide());
    straight("g++ strict", straight_strict());
}

void print_table(Collector& times) {
    fmt::print("\nMillions of cell steps a second, medians; in brackets our speed over theirs.\n"
               "{:<14}{:>6}{:>9}{:>16}{:>16}{:>16}\n",
               "system", "side", "jit", "g++", "g++ 512", "g++ strict");
    for (const System& system : systems()) {
        for (const std::int64_t side : sides) {
            const double ours = times.median(title(system, side, "jit"));
            if (ours <= 0) continue;
            const double cells = static_cast<double>(side * side);
            std::string line = fmt::format("{:<14}{:>6}{:>9.0f}", system.name, side,
                                           cells / ours * 1e-6);
            for (const char* who : {"g++", "g++ 512", "g++ strict"}) {
                const double theirs = times.median(title(system, side, who));
                line += theirs > 0 ? fmt::format("{:>9.0f} ({:.2f})", cells / theirs * 1e-6,
                                                 theirs / ours)
                                   : fmt::format("{:>16}", "-");
            }
            fmt::print("{}\n", line);
        }
    }
}

}  // namespace

void compare_throughput(Backend& backend) {
    check_agreement(backend);
    Contests contests(backend);
    for (const System& system : systems()) {
        for (const std::int64_t side : sides) register_contest(contests, system, side);
    }
    Collector times;
    benchmark::RunSpecifiedBenchmarks(&times);
    print_table(times);
}

}  // namespace cascade::bench
