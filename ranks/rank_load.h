// What each rank spends on the steps of a run, and which rank keeps the others waiting.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>
#include <span>
#include <string>

namespace cascade {

/// What a rank has spent on steps so far. Ranks send it as bytes.
struct RankLoad {
    /// Seconds in kernels and copies of the steps, without the seconds in messages.
    double computing = 0;
    double processor = 0;             ///< Processor seconds of all threads in the same time.
    double messages = 0;              ///< Seconds in messages, mostly waiting for other ranks.
    std::int64_t halo_bytes = 0;      ///< The bytes of halos sent to other ranks.
    std::int64_t halo_exchanges = 0;  ///< How often ranks have sent each other halos.
    std::array<char, 64> machine{};   ///< The name of the rank's machine, ended by a 0.
    bool is_stepping = false;         ///< Whether a TimeOfSteps exists.
};

/// Adds the time for which an object of this class exists to a load, as time spent on steps.
class TimeOfSteps {
public:
    explicit TimeOfSteps(RankLoad& load)
        : load_(load), began_(Clock::now()), processor_(processor_seconds(whole_process)) {
        load_.is_stepping = true;
    }
    ~TimeOfSteps() {
        load_.is_stepping = false;
        load_.computing += std::chrono::duration<double>(Clock::now() - began_).count();
        load_.processor += processor_seconds(whole_process) - processor_;
    }
    TimeOfSteps(const TimeOfSteps&) = delete;
    TimeOfSteps& operator=(const TimeOfSteps&) = delete;

private:
    friend class TimeOfMessages;
    using Clock = std::chrono::steady_clock;
    static constexpr clockid_t whole_process = CLOCK_PROCESS_CPUTIME_ID;
    static double processor_seconds(clockid_t clock);

    RankLoad& load_;
    Clock::time_point began_;
    double processor_;
};

/// Counts the time for which an object of this class exists as messages, not as steps. Does nothing
/// unless a TimeOfSteps exists. Also subtracts processor time, because MPI libraries use the
/// processor while they wait.
class TimeOfMessages {
public:
    explicit TimeOfMessages(RankLoad& load)
        : load_(load), began_(Clock::now()), processor_(TimeOfSteps::processor_seconds(own)) {}
    ~TimeOfMessages() {
        if (!load_.is_stepping) return;
        const double seconds = std::chrono::duration<double>(Clock::now() - began_).count();
        load_.messages += seconds;
        load_.computing -= seconds;
        load_.processor -= TimeOfSteps::processor_seconds(own) - processor_;
    }
    TimeOfMessages(const TimeOfMessages&) = delete;
    TimeOfMessages& operator=(const TimeOfMessages&) = delete;

private:
    using Clock = TimeOfSteps::Clock;
    static constexpr clockid_t own = CLOCK_THREAD_CPUTIME_ID;

    RankLoad& load_;
    Clock::time_point began_;
    double processor_;
};

/// A rank that takes more than twice the median time of all ranks for the same work.
struct SlowRank {
    std::size_t rank = 0;
    double times = 0;  ///< The rank's time as a multiple of the median.
};

/// The slowest rank, if its seconds are more than twice the median. With an even number of ranks,
/// the lower of the two middle times is the median, so that one of two ranks can count as slow.
/// Empty if the slowest rank took less than a second.
std::optional<SlowRank> slow_rank(std::span<const double> seconds);

}  // namespace cascade
