// A team of threads that stays alive for a run.
#pragma once

#include "core/rows.h"

#include <functional>
#include <memory>

namespace cascade {

/// The number of threads that the machine offers this process, at least 1.
int hardware_threads();

/// Abandons work that is no longer needed, such as a step of a run that is about to end. Throws an
/// exception that complete() catches. Any thread of a Team may call this function.
[[noreturn]] void abandon_work();

/// Calls `work`. Returns false if abandon_work() ended it.
bool complete(const std::function<void()>& work);

/// A team of `size` threads, or fewer if the system refuses to start more. The calling thread is
/// number 0. All threads run under FlushDenormals.
class Team {
public:
    explicit Team(int size);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    int size() const;

    /// Runs `work(index)` once on every thread and waits for all. If a thread throws, for example
    /// for lack of memory, threads that wait at a barrier give up, and run() throws the first
    /// exception. Not reentrant.
    void run(const std::function<void(int index)>& work);

    /// Runs `work(index)` once on each of threads 0 … active − 1 and waits for them. With active ==
    /// 1 the other threads stay asleep.
    void run(const std::function<void(int index)>& work, int active);

    /// Called inside `work` only: waits until every active thread has arrived. Writes made before
    /// the barrier are visible to all threads after it.
    void barrier();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cascade
