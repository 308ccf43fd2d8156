// Logs of a sweep: numbers over time in all runs, and their statistics over seeds.
#pragma once

#include "run/commands/ensemble.h"
#include "run/commands/variation.h"

#include <span>
#include <string>

namespace cascade {

/// A table with the rows of all logs. The varied values of a run precede each row of its log.
std::string logs_table(SweepResults results, std::span<const Variation> varied);

/// A table of statistics over seeds. It has a row for each combination of the values other than the
/// seed, each time of each stage, and each logged number. A row counts the runs that logged the
/// number at exactly this time. Runs that failed are left out.
std::string log_ensemble_table(SweepResults results, std::span<const Variation> varied);

}  // namespace cascade
