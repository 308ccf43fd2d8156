// Formats the results of `cascade bench`.
#pragma once

#include "run/commands/bench.h"

#include <string>

namespace cascade {

/// The table of one stage, with a sentence that names the limit of its speed. Ends with an empty
/// line.
std::string bench_table(const std::string& script, const StageBench& bench);

/// The limit of a stage's speed, such as "memory: 31.0 GB/s of 38.0 GB/s, 82 %". Empty if unknown.
std::string bound_sentence(const StageBench& bench);

/// The header line of `--csv`.
std::string bench_csv_header();
/// A stage as a row of CSV. If the stage has no steps, its measured columns are empty or 0.
std::string bench_csv_row(const std::string& script, const StageBench& bench);

}  // namespace cascade
