// A run that several processes share, its *ranks*. Each rank runs the same script from the first
// stage to the last, but takes the steps of its part of the grid alone. Everything else is computed
// by every rank, from whole planes that the ranks complete together. So all ranks take the same
// decisions, and the result is the same bit for bit with any number of ranks.
#pragma once

#include "core/result.h"
#include "ranks/messenger.h"
#include "ranks/rank_load.h"
#include "solvers/executor.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

class Ranks {
public:
    /// The messenger must outlive the object.
    explicit Ranks(Messenger& messenger);

    int rank() const { return messenger_.rank(); }
    int count() const { return messenger_.count(); }
    bool is_root() const { return rank() == 0; }
    Messenger& messenger() { return messenger_; }

    /// Set on rank 0 to end the run on all ranks, after the batch of steps that they have begun.
    std::atomic<bool>& end_flag() { return is_to_end_; }

    /// Fails if this rank and rank 0 pass different texts. `what` names the text in the message.
    Result<void> compare(std::string_view what, std::string_view text);

    /// The largest number of parts into which a grid can be cut.
    static std::int64_t most_parts(const Grid& grid);

    /// Makes executors that take the steps of this rank's part. On a grid with fewer rows or slices
    /// than ranks, each rank takes all steps. Sets `cancel` on all ranks when end_flag() is set on
    /// rank 0. `cancel` and this object must outlive the executors.
    MakeExecutor executor(std::atomic<bool>& cancel);

    /// What this rank has spent on steps so far.
    RankLoad& load() { return load_; }
    /// What all ranks have spent. All ranks must call this function.
    std::vector<RankLoad> loads();
    /// Sets a function that rank 0 calls with a sentence about a rank that keeps the others
    /// waiting, once for each such rank.
    void tell_slow(std::function<void(const std::string&)> tell) { tell_slow_ = std::move(tell); }
    /// Whether ten seconds have passed since the last call of compare_loads().
    bool is_time_to_compare() const;
    /// Finds ranks that have taken more than twice the median time since the last call. All ranks
    /// must call this function.
    void compare_loads();

    /// Waits for all ranks and ends the communication. Returns `status` of rank 0 on rank 0, and 0
    /// on every other rank.
    int finish(int status);
    /// Ends all ranks with this status, which must be from 1 to 255.
    void abort(int status) { messenger_.abort(status); }

private:
    Messenger& messenger_;
    std::atomic<bool> is_to_end_{false};
    RankLoad load_;
    std::function<void(const std::string&)> tell_slow_;
    std::vector<RankLoad> compared_;  ///< All loads at the last comparison.
    std::chrono::steady_clock::time_point compared_at_ = std::chrono::steady_clock::now();
    std::vector<bool> is_told_;  ///< For each rank, whether it has been named as slow.
};

/// A text such as "rank 1 of 4 on NAME", where NAME is the name of the rank's machine.
std::string name_of_rank(const Ranks& ranks);

}  // namespace cascade
