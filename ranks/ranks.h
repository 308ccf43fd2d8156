// A run that several processes share, its *ranks*. Each rank runs the same script from the first
// stage to the last, but takes the steps of its part of the grid alone. Everything else is computed
// by every rank, from whole planes that the ranks complete together. So all ranks take the same
// decisions, and the result is the same bit for bit with any number of ranks.
#pragma once

#include "core/result.h"
#include "ranks/messenger.h"
#include "solvers/executor.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

class Ranks {
public:
    /// The messenger must outlive the object.
    explicit Ranks(Messenger& messenger) : messenger_(messenger) {}

    int rank() const { return messenger_.rank(); }
    int count() const { return messenger_.count(); }
    bool is_root() const { return rank() == 0; }

    /// Set on rank 0 to end the run on all ranks, after the batch of steps that they have begun.
    std::atomic<bool>& end_flag() { return is_to_end_; }

    /// Fails if this rank and rank 0 pass different texts. `what` names the text in the message.
    Result<void> compare(std::string_view what, std::string_view text);

    /// The number of parts into which a grid can be cut.
    static std::int64_t most_parts(const Grid& grid);

    /// Makes executors that take the steps of this rank's part. On a grid with fewer rows or slices
    /// than ranks, each rank takes all steps. Sets `cancel` on all ranks when rank 0 is to end. The
    /// flag and this object must outlive the executors.
    MakeExecutor executor(std::atomic<bool>& cancel);

    /// Waits for all ranks, ends the communication, and returns the exit status of rank 0 on rank
    /// 0, and 0 on all others.
    int finish(int status);
    /// Ends all ranks with this status, which must be from 1 to 255.
    void abort(int status) { messenger_.abort(status); }

private:
    Messenger& messenger_;
    std::atomic<bool> is_to_end_{false};
};

/// "rank 1 of 4 (on the machine NAME)"
std::string name_of_rank(const Ranks& ranks);

}  // namespace cascade
