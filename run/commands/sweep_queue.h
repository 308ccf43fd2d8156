// Hands out the runs of a sweep to the threads of this process. If several ranks share the sweep,
// hands out runs to the threads of all ranks.
//
// Rank 0 has the queue. Another rank asks for a run when one of its threads is idle, and sends the
// result back. So only rank 0 writes results, and a slow rank takes fewer runs.
#pragma once

#include "ranks/messenger.h"
#include "run/commands/sweep_result.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cascade {

class SweepQueue {
public:
    /// A run that another rank has taken.
    struct Taken {
        std::size_t run = 0;
        SweepResult result;
    };

    /// `waiting` contains the runs to hand out. All ranks but rank 0 ignore it. `messenger` is null
    /// if this process is alone. Otherwise it must outlive the queue.
    SweepQueue(std::vector<std::size_t> waiting, Messenger* messenger);

    /// Whether this process hands out the runs and keeps the results.
    bool is_root() const { return messenger_ == nullptr || messenger_->rank() == 0; }

    /// Returns the next run for a thread of this process, or an empty optional if there are no more
    /// runs. If rank 0 must hand out the run, waits for its message. `serves` must be true in the
    /// thread that calls serve().
    std::optional<std::size_t> next(bool serves);
    /// Stores a result, which the next call of serve() sends to rank 0. Must not be called on rank
    /// 0.
    void give(std::size_t run, const SweepResult& result);
    /// Stops handing out runs. On rank 0, also cancels the runs of all other ranks.
    void cancel();
    /// Whether the runs of this process must end.
    bool is_cancelled() const;

    /// Sends and receives messages, and returns the results that other ranks have sent. Only one
    /// thread may call serve() and has_finished(), and must call them often.
    std::vector<Taken> serve();
    /// Must be called repeatedly after the threads of this process have ended. On rank 0, returns
    /// true when all other ranks have ended their runs. On any other rank, returns true when rank 0
    /// has confirmed that this rank has ended its runs.
    bool has_finished();

private:
    void answer(const Messenger::Letter& letter, std::vector<Taken>& taken);
    void obey(const Messenger::Letter& letter);
    void post(int rank, const std::string& text);

    Messenger* const messenger_;
    mutable std::mutex mutex_;  ///< Protects the members below.
    std::condition_variable changed_;
    std::deque<std::size_t> waiting_;  ///< On other ranks: the runs received for idle threads.
    std::deque<std::string> results_;  ///< The results that must be sent to rank 0.
    std::size_t asked_ = 0;  ///< The number of runs for which the next call of serve() must ask.
    std::set<int> busy_;     ///< On rank 0: the other ranks that have not ended.
    bool is_over_ = false;   ///< Whether there are no more runs.
    bool is_cancelled_ = false;
    /// Whether rank 0 has told the other ranks that the sweep was cancelled, or this rank has told
    /// rank 0 that its runs have ended.
    bool has_told_ = false;
    bool is_released_ = false;
};

}  // namespace cascade
