// What Google Benchmark measures, as medians.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace cascade::bench {

/// Reads the flags of Google Benchmark after defaults of ours: nine repetitions, which take turns
/// at random. False, with a message, where a flag is unknown.
bool initialize_benchmarks(int argc, char** argv);

/// Keeps every repetition's time and prints nothing. Serves any number of runs.
class Medians : public benchmark::BenchmarkReporter {
public:
    /// A filter leaves most contests nothing to run, which is no mistake.
    Medians() { SetErrorStream(&nowhere_); }

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override;

    /// Median of the seconds that an iteration took; 0 where the benchmark was filtered out.
    double median(const std::string& name);
    /// The least of them; 0 where the benchmark was filtered out.
    double least(const std::string& name);

private:
    std::ostream nowhere_{nullptr};
    std::map<std::string, std::vector<double>> seconds_;
};

}  // namespace cascade::bench
