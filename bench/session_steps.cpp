// cascade_session_bench: how much longer steps take in a session.
//
// Compares LiveRun::advance() with a Session whose reader asks for a snapshot 30 times a second,
// for the same steps, in one process on one thread. Prints medians of the processor time of a step.
// All flags of Google Benchmark work (--benchmark_filter=/512/).
#include "bench/medians.h"
#include "run/session/session.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace cascade::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t warm_up = 512;

template <typename T>
std::unique_ptr<T> begin(std::int64_t side) {
    RunControl control;
    SimulationOptions options;
    options.threads = 1;
    const std::string text = fmt::format(
        "domain {{ grid: {0}, {0} }}\nstage only: gray_scott {{ iterations: 100000000 }}\n", side);
    auto made = T::begin(load_script("bench", text, "."), options, control);
    if (!made) {
        std::fputs(made.error().messages(false).c_str(), stderr);
        std::exit(1);
    }
    return std::move(*made);
}

void advance(benchmark::State& state) {
    const auto run = begin<LiveRun>(state.range(0));
    RunControl control;
    control.checks_later = true;
    (void)run->advance(warm_up, control);
    for (auto _ : state) (void)run->advance(state.range(1), control);
}

/// Reads snapshots 30 times a second until all steps are taken.
void wait_for_end(Session& session, std::int64_t last) {
    while (session.newest()->place.steps < last) std::this_thread::sleep_for(33ms);
}

void session(benchmark::State& state) {
    const auto session = begin<Session>(state.range(0));
    std::int64_t last = warm_up;
    session->post(TakeSteps{warm_up});
    wait_for_end(*session, last);
    for (auto _ : state) {
        last += state.range(1);
        session->post(TakeSteps{state.range(1)});
        wait_for_end(*session, last);
    }
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    using namespace cascade::bench;
    if (!initialize_benchmarks(argc, argv)) return 64;
    std::printf("%-8s %14s %14s %8s\n", "side", "advance", "session", "ratio");
    for (const std::int64_t side : {64, 256, 512, 1024, 2048}) {
        const std::int64_t steps = (std::int64_t{1} << 31) / (side * side);
        benchmark::ClearRegisteredBenchmarks();
        const auto name = [&](const char* how) { return fmt::format("{}/{}", side, how); };
        for (const auto& [how, function] :
             {std::pair{"advance", &advance}, {"session", &session}}) {
            benchmark::RegisterBenchmark(name(how).c_str(), function)
                ->Args({side, steps})
                ->MeasureProcessCPUTime();
        }
        Medians medians;
        benchmark::RunSpecifiedBenchmarks(&medians);
        const auto of_step = [&](const char* how) {
            return 1e6 * medians.median(name(how)) / static_cast<double>(steps);
        };
        const double alone = of_step("advance"), in_session = of_step("session");
        if (alone <= 0 || in_session <= 0) continue;
        std::printf("%-8s %11.2f us %11.2f us %8.3f\n", std::to_string(side).c_str(), alone,
                    in_session, alone / in_session);
        std::fflush(stdout);
    }
}
