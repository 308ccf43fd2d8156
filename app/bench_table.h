// What `cascade bench` prints.
#pragma once

#include "run/commands/bench.h"

#include <string>

namespace cascade {

/// The table of one stage, with the sentence that says what bounds it. Ends with an empty line.
std::string bench_table(const std::string& script, const StageBench& bench);

/// What bounds the stage, such as "memory: 31.0 GB/s of 38.0 GB/s, 82 %"; empty if nothing is
/// known.
std::string bound_sentence(const StageBench& bench);

/// The header line of `--csv`.
std::string bench_csv_header();
/// A stage as a line of CSV; the measured columns of a stage that has no steps are empty or 0.
std::string bench_csv_row(const std::string& script, const StageBench& bench);

}  // namespace cascade
