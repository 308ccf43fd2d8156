// Formats the results of `cascade bench`.
#pragma once

#include "run/commands/bench.h"

#include <string>

namespace cascade {

/// Formats the results of one stage as a table, followed by a sentence that names the limit of the
/// stage's speed and by an empty line.
std::string bench_table(const std::string& script, const StageBench& bench);

/// Names the limit of a stage's speed, such as "memory: 31.0 GB/s of 38.0 GB/s, 82 %". Returns an
/// empty string if the limit is unknown.
std::string bound_sentence(const StageBench& bench);

/// Returns the header line of `--csv`.
std::string bench_csv_header();
/// Formats the results of a stage as a row of CSV. If the stage takes no steps, the number of steps
/// is 0 and all measured columns are empty.
std::string bench_csv_row(const std::string& script, const StageBench& bench);

}  // namespace cascade
