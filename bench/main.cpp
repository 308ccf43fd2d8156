// cascade_bench: speed of Cascade's native code, one core, against straight C++ in this process.
//
// --lanes=8 takes vectors of 8 cells (4, 8 or 16; without it the widest the processor has).
// All flags of Google Benchmark work (--benchmark_filter=turing/512, --benchmark_repetitions=21).
#include "bench/comparison.h"
#include "bench/latency.h"
#include "core/floating_point.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

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

    // Defaults come first, so that the command line wins.
    std::vector<std::string> words = {argv[0], "--benchmark_repetitions=9",
                                      "--benchmark_min_time=0.05",
                                      "--benchmark_enable_random_interleaving=true"};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 64;
    cascade::bench::compare_throughput(*backend);
}
