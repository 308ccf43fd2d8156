// cascade_embedding_bench: how much longer steps take in a program that embeds Cascade and takes
// them one at a time.
//
// Compares Pattern::step(1) in a loop with Pattern::step(n), in one process on one thread. Prints
// medians of the processor time of a step. The work of a step is the same, so the difference is the
// cost of a call. All flags of Google Benchmark work (--benchmark_filter=/256/).
#include "bench/medians.h"
#include "cascade/cascade.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace cascade::bench {
namespace {

constexpr std::int64_t warm_up = 256;

struct Kind {
    const char* name;
    const char* stage;  ///< A stage without its closing brace. Its end is never reached.
};
constexpr Kind kinds[] = {
    {"spots", "stage only: turing_spots { iterations: 100000000; ka: 1/80"},
    {"chosen", "stage only: turing_spots { duration: 100000000; ka: 1/80; speed: auto"},
};

/// Takes `state.range(1)` steps per iteration, `each` at a time, or all at once if `each` is 0.
void take_steps(benchmark::State& state, const Kind& kind, std::int64_t each) {
    const std::int64_t side = state.range(0), steps = state.range(1);
    PatternOptions options;
    options.threads = 1;
    Pattern pattern(fmt::format("domain {{ grid: {0}, {0} }}\n{1} }}\n", side, kind.stage),
                    options);
    if (!pattern.ok() || pattern.step(warm_up) != warm_up) {
        std::fputs((pattern.messages() + pattern.error()).c_str(), stderr);
        std::exit(1);
    }
    const std::int64_t at_once = each > 0 ? each : steps;
    for (auto _ : state) {
        for (std::int64_t taken = 0; taken < steps; taken += at_once) pattern.step(at_once);
    }
}

/// The number of steps in an iteration, which take some milliseconds.
std::int64_t steps_on(std::int64_t side) { return side <= 64 ? 4096 : 256; }

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    using namespace cascade::bench;
    if (!initialize_benchmarks(argc, argv)) return 64;
    std::printf("%-12s %12s %12s %8s %12s\n", "", "step(n)", "step(1)", "ratio", "more");
    for (const Kind& kind : kinds) {
        for (const std::int64_t side : {64, 256}) {
            const std::int64_t steps = steps_on(side);
            const auto name = [&](const char* how) {
                return fmt::format("{}/{}/{}", kind.name, side, how);
            };
            benchmark::ClearRegisteredBenchmarks();
            for (const auto& [how, each] : {std::pair{"n", 0}, std::pair{"1", 1}}) {
                benchmark::RegisterBenchmark(name(how).c_str(), [&kind, each = each](
                                                                    benchmark::State& state) {
                    take_steps(state, kind, each);
                })->Args({side, steps});
            }
            Medians medians;
            benchmark::RunSpecifiedBenchmarks(&medians);
            const auto of_step = [&](const char* how) {
                return 1e6 * medians.median(name(how)) / static_cast<double>(steps);
            };
            const double together = of_step("n"), one = of_step("1");
            if (together <= 0 || one <= 0) continue;
            std::printf("%-12s %9.2f us %9.2f us %8.3f %9.2f us\n",
                        fmt::format("{}/{}", kind.name, side).c_str(), together, one,
                        one / together, one - together);
            std::fflush(stdout);
        }
    }
}
