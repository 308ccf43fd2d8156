// cascade_halide_bench: speed of Cascade's native code on one core, compared with Halide's in this
// process.
//
// For each system and size, Cascade takes turns with several schedules of Halide. The table names
// the best schedule. All flags of Google Benchmark work (--benchmark_filter=turing/512).
#include "bench/cascade_side.h"
#include "bench/medians.h"
#include "bench/peers/halide_side.h"
#include "core/floating_point.h"
#include "jit/jit.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

struct System {
    std::string name;
    HalideSystem system;
    std::string (*text)(const GridSize& grid);
    std::string varying;
    std::vector<std::int64_t> sides;
};

std::vector<System> systems() {
    return {{"turing", HalideSystem::turing, turing_text, "beta", {256, 512, 2048, 8192}},
            {"gray_scott", HalideSystem::gray_scott, gray_scott_text, "", {256, 512, 2048, 8192}},
            {"stripes", HalideSystem::stripes, stripes_text, "ai", {256, 512, 2048}}};
}

std::vector<HalideSchedule> schedules() {
    using Kind = HalideSchedule::Kind;
    return {{Kind::rows, 1, 0, 1},     {Kind::rows, 1, 0, 4},    {Kind::tiles, 2, 256, 64},
            {Kind::tiles, 4, 256, 64}, {Kind::windows, 2, 0},    {Kind::windows, 4, 0},
            {Kind::windows, 8, 0},     {Kind::windows, 16, 0},   {Kind::windows, 8, 512},
            {Kind::windows, 16, 1024}, {Kind::windows, 4, 2048}, {Kind::windows, 16, 2048}};
}

/// Ends the program if the sides compute different values, because then the comparison would be
/// worthless.
void check_agreement(Backend& backend, const System& system, HalideProgram& program) {
    constexpr std::int64_t steps = 64;
    const std::int64_t side = std::max(256, program.schedule().width);
    CascadeSide ours(system.text({side, side}), backend);
    HalideSide theirs(ours, system.varying);
    ours.advance(steps);
    theirs.advance(program, steps);
    const double difference = largest_difference(ours.species(), theirs.species());
    if (difference < 1e-4) return;
    std::fprintf(stderr, "cascade_halide_bench: %s, %s, differs by %g\n", system.name.c_str(),
                 program.schedule().name().c_str(), difference);
    std::exit(1);
}

/// The programs of a system, by schedule. Each program is made and checked when it is first needed,
/// because compiling takes seconds.
class Programs {
public:
    Programs(Backend& backend, const System& system) : backend_(backend), system_(system) {}

    HalideProgram& get(const HalideSchedule& schedule) {
        auto& program = made_[schedule.name()];
        if (!program) {
            program = std::make_unique<HalideProgram>(system_.system, schedule);
            check_agreement(backend_, system_, *program);
        }
        return *program;
    }

private:
    Backend& backend_;
    const System& system_;
    std::map<std::string, std::unique_ptr<HalideProgram>> made_;
};

std::string title(const System& system, std::int64_t side, const std::string& who) {
    return fmt::format("{}/{}/{}", system.name, side, who);
}

/// Both sides of the comparison, for one system at one size.
struct Contest {
    Contest(const System& system, const GridSize& grid, Backend& backend)
        : ours(system.text(grid), backend), theirs(ours, system.varying) {}
    CascadeSide ours;
    HalideSide theirs;
};

/// Cascade and each schedule take turns. Both sides are freed afterwards.
void run_contest(Backend& backend, const System& system, std::int64_t side, Programs& programs,
                 Medians& times) {
    const GridSize grid = {side, side};
    const std::int64_t steps = steps_between_looks(grid);
    std::unique_ptr<Contest> contest;
    const auto contest_made = [&]() -> Contest& {
        if (!contest) contest = std::make_unique<Contest>(system, grid, backend);
        return *contest;
    };
    benchmark::RegisterBenchmark(title(system, side, "jit").c_str(), [&](benchmark::State& state) {
        CascadeSide& ours = contest_made().ours;
        for (auto _ : state) ours.advance(steps);
    });
    for (const HalideSchedule& schedule : schedules()) {
        if (schedule.width > side) continue;
        benchmark::RegisterBenchmark(title(system, side, schedule.name()).c_str(),
                                     [&, schedule](benchmark::State& state) {
                                         HalideProgram& program = programs.get(schedule);
                                         HalideSide& theirs = contest_made().theirs;
                                         for (auto _ : state) theirs.advance(program, steps);
                                     });
    }
    benchmark::RunSpecifiedBenchmarks(&times);
    benchmark::ClearRegisteredBenchmarks();
}

void print_rows(const System& system, Medians& times) {
    for (const std::int64_t side : system.sides) {
        const double ours = times.median(title(system, side, "jit"));
        if (ours <= 0) continue;
        const auto speed = [&](double seconds) {
            const GridSize grid = {side, side};
            return static_cast<double>(side * side * steps_between_looks(grid)) / seconds * 1e-6;
        };
        double best = 0;
        std::string best_name;
        for (const HalideSchedule& schedule : schedules()) {
            const std::string name = schedule.name();
            const double theirs = times.median(title(system, side, name));
            if (theirs <= 0) continue;
            fmt::print("{:<12}{:>6}  {:<32}{:>9.0f}\n", system.name, side, name, speed(theirs));
            if (best > 0 && theirs >= best) continue;
            best = theirs;
            best_name = name;
        }
        fmt::print("{:<12}{:>6}  {:<32}{:>9.0f}", system.name, side, "Cascade", speed(ours));
        if (best > 0) fmt::print(", {:.2f} times {}", best / ours, best_name);
        fmt::print("\n\n");
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    using namespace cascade::bench;
    const cascade::FlushDenormals environment;
    if (!initialize_benchmarks(argc, argv)) return 64;
    const auto backend = cascade::make_jit();
    if (!backend) {
        std::fprintf(stderr, "cascade_halide_bench: %s\n", backend.error().message.c_str());
        return 1;
    }
    fmt::print("Millions of cell steps a second, medians.\n\n");
    for (const System& system : systems()) {
        Programs programs(**backend, system);
        Medians times;
        for (const std::int64_t side : system.sides) {
            run_contest(**backend, system, side, programs, times);
        }
        print_rows(system, times);
    }
}
