// Collects the measurements of Google Benchmark as medians.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace cascade::bench {

/// Reads the flags of Google Benchmark. By default, there are nine repetitions, which alternate at
/// random. Returns false, with a message, if a flag is unknown.
bool initialize_benchmarks(int argc, char** argv);

/// Stores every repetition's time and prints nothing. May be used for any number of runs.
class Medians : public benchmark::BenchmarkReporter {
public:
    /// Hides the error that no benchmark matches, because a filter leaves most comparisons without
    /// a benchmark.
    Medians() { SetErrorStream(&nowhere_); }

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override;

    /// Median of the seconds per iteration, or 0 if the benchmark was filtered out.
    double median(const std::string& name);
    /// The least seconds per iteration, or 0 if the benchmark was filtered out.
    double least(const std::string& name);

private:
    std::ostream nowhere_{nullptr};
    std::map<std::string, std::vector<double>> seconds_;
};

}  // namespace cascade::bench
