// cascade_bench: speed of Cascade's native code, one core, against straight C++ in this process.
//
// --lanes=8 takes vectors of 8 cells (4, 8 or 16; without it the widest the processor has).
// All flags of Google Benchmark work (--benchmark_filter=turing/512, --benchmark_repetitions=21).
#include "bench/comparison.h"
#include "bench/latency.h"
#include "bench/medians.h"
#include "core/floating_point.h"

#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
    // Both sides work in the one environment of the spec's numerics.
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
