// cascade_bench: speed of Cascade's native code on one core, compared with straight C++ in this
// process.
//
// --lanes=8 selects vectors of 8 cells (4, 8 or 16; by default the widest that the processor has).
// All flags of Google Benchmark work (--benchmark_filter=turing/512, --benchmark_repetitions=21).
#include "bench/comparison.h"
#include "bench/latency.h"
#include "bench/medians.h"
#include "core/floating_point.h"

#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
    // Both sides run in the floating-point environment that the spec prescribes.
    const cascade::FlushDenormals environment;
    int lanes = 0;
    if (argc > 1 && std::string_view(argv[1]).starts_with("--lanes=")) {
        lanes = std::atoi(argv[1] + 8);
        argv[1] = argv[0];
        ++argv;
        --argc;
    }
    const auto backend = cascade::bench::first_use(lanes);
    cascade::bench::later_use(*backend);

    if (!cascade::bench::initialize_benchmarks(argc, argv)) return 64;
    cascade::bench::compare_throughput(*backend);
}
