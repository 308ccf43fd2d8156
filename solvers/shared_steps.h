// Steps that several processes share.
#pragma once

#include <cstdint>

namespace cascade {

/// The decisions, before each batch of steps, that a time loop bases on the clock.
struct LoopDecision {
    std::int64_t steps = 0;     ///< The number of steps in the batch.
    bool is_looked_at = false;  ///< Whether the values after the batch are checked and observed.
    bool is_kept = false;       ///< Whether the state after the batch is saved.
};

/// Makes executors in several processes that share the steps decide alike.
class SharedSteps {
public:
    virtual ~SharedSteps() = default;

    /// Called in all processes before a batch of steps. Returns the decision of the first process.
    /// If the call sets the flag that cancels the run, it sets this flag in all processes.
    virtual LoopDecision agree(LoopDecision own) = 0;
};

}  // namespace cascade
