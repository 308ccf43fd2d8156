// cascade_bench: speed of Cascade's native code, one core, against straight C++ in this process.
//
// All flags of Google Benchmark work (--benchmark_filter=turing/512, --benchmark_repetitions=21).
#include "bench/comparison.h"
#include "bench/latency.h"
#include "core/floating_point.h"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

int main(int argc, char** argv) {
    // Both sides work in the one environment of the spec's numerics.
    const cascade::FlushDenormals environment;
    const auto backend = cascade::bench::first_use();
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
