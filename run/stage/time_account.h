// Where the time of a run goes, for `--timing`.
//
// The thread that runs keeps the account. It does one thing at each moment, and a nested scope
// takes over the time of the outer one. The parts therefore add up to the whole by construction.
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

inline double seconds_since(std::chrono::steady_clock::time_point moment) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - moment).count();
}

/// The categories of time.
enum class Spent : std::uint8_t {
    reading,    ///< Scripts with the files they use, and the check.
    cells,      ///< The cells of a model, and the values that formulas read from places on it.
    starting,   ///< Starting values, masks and step-invariants.
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
        int threads = 1;           ///< The number of threads of its last steps.
        Stepping stepping;         ///< How these steps passed through memory.
        bool has_refused = false;  ///< Was a kernel interpreted because it failed to compile?
    };

    /// Begins now, with `rest`.
    TimeAccount();

    /// Charges time to one category while it lives; scopes nest. Does nothing without an account.
    class Scope {
    public:
        /// Of a stage, by number; without one, of the stage of the enclosing scope.
        Scope(TimeAccount* account, Spent what, std::optional<std::uint32_t> stage = std::nullopt);
        Scope(TimeAccount& account, Spent what, std::optional<std::uint32_t> stage = std::nullopt)
            : Scope(&account, what, stage) {}
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        TimeAccount* account_;
        Spent what_ = Spent::rest;
        std::optional<std::uint32_t> stage_;
    };

    /// The stage with this number, added if it is new.
    Stage& stage(std::uint32_t number);

    /// The origins of kernels, up to the last step.
    KernelCounts kernels;

    const std::vector<Stage>& stages() const { return stages_; }
    /// Seconds so far, in all stages and outside of them. Includes the current scope up to now.
    double seconds(Spent what);
    /// Seconds since the account began: the sum of all parts.
    double seconds();
    /// Processor time of the program before that, mostly for loading libraries.
    double seconds_before() const { return before_; }

private:
    void settle();

    double before_ = 0;
    Clock::time_point since_;
    Spent what_ = Spent::rest;
    std::optional<std::uint32_t> stage_;
    std::array<double, spent_count> outside_{};  ///< Outside of stages.
    std::vector<Stage> stages_;
};

}  // namespace cascade
