// Threads that stay alive for a run and meet at every step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace cascade {

/// Half-open range of rows.
struct RowRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    bool empty() const { return begin >= end; }
};

/// Part `index` of `count` nearly equal parts of [0, rows).
RowRange split_rows(std::int64_t rows, int index, int count);

/// How many threads the machine offers this process (at least 1).
int hardware_threads();

/// A team of `size` threads, or of fewer where the system denies more; the calling thread is number
/// 0. Each works in FlushDenormals.
class Team {
public:
    explicit Team(int size);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    int size() const;

    /// Runs `work(index)` once on every thread and returns when all are done. `work` must not
    /// throw. Not reentrant.
    void run(const std::function<void(int index)>& work);

    /// The same on threads 0 … active − 1 only. With one, the others are left asleep.
    void run(const std::function<void(int index)>& work, int active);

    /// Inside `work` only: waits until every thread that works has arrived. What a thread wrote
    /// before is seen by all after it. Spins a little, then yields.
    void barrier();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cascade
