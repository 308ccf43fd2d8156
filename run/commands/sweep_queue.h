// Hands out the runs of a sweep: to the threads of this process and, if several ranks share the
// sweep, to the threads of all ranks.
//
// Rank 0 has the queue. Another rank asks for a run when one of its threads is idle, and sends the
// result back. So rank 0 alone writes results, and a slow rank takes fewer runs.
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

    /// `waiting` are the runs to hand out. All ranks but rank 0 ignore them. `messenger` is null if
    /// this process is alone. Otherwise it must outlive the queue.
    SweepQueue(std::vector<std::size_t> waiting, Messenger* messenger);

    /// Whether this process hands out the runs and keeps the results.
    bool is_root() const { return messenger_ == nullptr || messenger_->rank() == 0; }

    /// The next run for a thread of this process. Waits if rank 0 hands out the runs. Empty if
    /// there are no more. `serves` must be true in the thread that calls serve().
    std::optional<std::size_t> next(bool serves);
    /// Sends a result to rank 0 with the next call of serve(). For all ranks but rank 0.
    void give(std::size_t run, const SweepResult& result);
    /// Hands out no more runs. On rank 0 it also cancels the runs of all other ranks.
    void cancel();
    /// Whether the runs of this process are to end.
    bool is_cancelled() const;

    /// Sends and receives messages. Only one thread may call this and has_finished(), and must do
    /// so often. Returns the results that other ranks have sent.
    std::vector<Taken> serve();
    /// Called repeatedly after the threads of this process have ended. On rank 0, returns true when
    /// all other ranks have ended their runs. On another rank, returns true when rank 0 has
    /// confirmed that this rank has ended its runs.
    bool has_finished();

private:
    void answer(const Messenger::Letter& letter, std::vector<Taken>& taken);
    void obey(const Messenger::Letter& letter);
    void post(int rank, const std::string& text);

    Messenger* const messenger_;
    mutable std::mutex mutex_;  ///< Protects the members below.
    std::condition_variable changed_;
    std::deque<std::size_t> waiting_;  ///< On other ranks: the runs received for idle threads.
    std::deque<std::string> results_;  ///< The results to be sent to rank 0.
    std::size_t asked_ = 0;            ///< The number of runs that serve() has to ask for.
    std::set<int> busy_;               ///< On rank 0: the other ranks that have not ended.
    bool is_over_ = false;             ///< Whether there are no more runs.
    bool is_cancelled_ = false;
    bool has_told_ = false;  ///< Whether the end of the runs, or their cancel, was announced.
    bool is_released_ = false;
};

}  // namespace cascade
