// Where the time of a run goes, for `--timing`.
//
// The account is kept by the thread that runs: at each moment it does one thing, and a scope within
// a scope takes the time over. So the parts add up to everything by construction.
#pragma once

#include "ir/backend.h"
#include "solvers/stepping.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// What time is spent on.
enum class Spent : std::uint8_t {
    reading,    ///< Scripts, the files they use, and their check.
    cells,      ///< Of a model, and what formulas read of places on it.
    starting,   ///< Starting values, masks, and what no step changes.
    compiling,  ///< From checked formulas to code.
    stepping,
    drawing,  ///< Pictures, frames, logs, files.
    rest,     ///< The time that no other row accounts for.
};
inline constexpr std::size_t spent_count = 7;

class TimeAccount {
public:
    using Clock = std::chrono::steady_clock;

    struct Stage {
        std::string name;
        std::array<double, spent_count> seconds{};  ///< By Spent.
        std::int64_t steps = 0;
        std::int64_t cells = 0;
        int threads = 1;    ///< That took its last steps.
        Stepping stepping;  ///< How these went through memory.
    };

    /// Begins now, with the rest.
    TimeAccount();

    /// While it lives time is spent on one thing; scopes nest. Of no account it does nothing.
    class Scope {
    public:
        /// Of a stage, by number; without one, of the stage of the scope around it.
        Scope(TimeAccount* account, Spent what, std::optional<std::uint32_t> stage = std::nullopt);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        TimeAccount* account_;
        Spent what_ = Spent::rest;
        std::optional<std::uint32_t> stage_;
    };

    /// The stage of a number, which is there from now on.
    Stage& stage(std::uint32_t number);

    /// Where kernels came from, up to the last step.
    KernelCounts kernels;

    const std::vector<Stage>& stages() const { return stages_; }
    /// Seconds so far, in all stages and outside of them. Settles what is going on.
    double seconds(Spent what);
    /// Seconds since the account began: the sum of all parts.
    double seconds();
    /// Processor time that the program took before, most of it to load its libraries.
    double seconds_before() const { return before_; }

private:
    void settle();

    double before_ = 0;
    Clock::time_point since_;
    Spent what_ = Spent::rest;
    std::optional<std::uint32_t> stage_;
    std::array<double, spent_count> outside_{};  ///< Of no stage.
    std::vector<Stage> stages_;
};

}  // namespace cascade
