// What `cascade bench` prints.
#pragma once

#include "run/commands/bench.h"

#include <string>

namespace cascade {

/// The table of one stage, and the sentence that says what bounds it. Ends with an empty line.
std::string bench_table(const std::string& script, const StageBench& bench);

/// "memory bounds it: 31.0 of 38.0 GB/s, 82 %".
std::string bound_sentence(const StageBench& bench);

/// Names of the columns of `--csv`.
std::string bench_csv_header();
/// A stage as a row; nothing is measured where there is nothing to measure.
std::string bench_csv_row(const std::string& script, const StageBench& bench);

}  // namespace cascade
