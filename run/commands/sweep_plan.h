// The runs of a sweep, checked before the first step.
#pragma once

#include "run/commands/sweep.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct PlannedRun {
    Overrides overrides;
    std::vector<std::string> values;  ///< One for each varied name.
    std::string key;                  ///< The result of key_of_run().
};

struct SweepPlan {
    std::vector<PlannedRun> runs;          ///< All runs. Only runs of the part are filled in.
    std::shared_ptr<const Program> first;  ///< The program of the first run of the part.
    std::vector<std::size_t> own;          ///< The numbers of the runs of the part, in order.
    bool has_one_spacing = true;  ///< Whether cells are equally large in all runs of the part.
    double memory_of_a_run = 0;   ///< In bytes. Every run checks its memory again.
};

/// Loads and checks the script with the values of every run of the part.
tl::expected<SweepPlan, SweepError> plan_sweep(const Script& script, const SweepRequest& request);

/// Loads the script with the values of a run.
Script load(const Script& script, const PlannedRun& run);

}  // namespace cascade
