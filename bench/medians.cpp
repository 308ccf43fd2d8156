#include "bench/medians.h"

#include <algorithm>
#include <cstddef>

namespace cascade::bench {

bool initialize_benchmarks(int argc, char** argv) {
    // Defaults come first, so that options of the command line override them.
    std::vector<std::string> words = {argv[0], "--benchmark_repetitions=9",
                                      "--benchmark_min_time=0.05",
                                      "--benchmark_enable_random_interleaving=true"};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    return !benchmark::ReportUnrecognizedArguments(count, pointers.data());
}

void Medians::ReportRuns(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
        if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
        seconds_[run.run_name.function_name].push_back(run.cpu_accumulated_time /
                                                       static_cast<double>(run.iterations));
    }
}

double Medians::median(const std::string& name) {
    std::vector<double>& times = seconds_[name];
    if (times.empty()) return 0;
    std::sort(times.begin(), times.end());
    const std::size_t half = times.size() / 2;
    return times.size() % 2 ? times[half] : (times[half - 1] + times[half]) / 2;
}

double Medians::least(const std::string& name) {
    const std::vector<double>& times = seconds_[name];
    return times.empty() ? 0 : *std::min_element(times.begin(), times.end());
}

}  // namespace cascade::bench
