// Records how the time of a run is spent, for the option `--timing`.
//
// Only the thread of the run records times. A nested scope pauses the scope around it. So each
// moment is counted only once, and the categories add up to the whole time.
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
    reading,  ///< Reading and checking scripts and their files.
    /// Making the cells of a model, and computing values that formulas read at positions on it.
    cells,
    starting,   ///< Computing starting values, masks and step-invariants.
    compiling,  ///< Compiling kernels, from checked formulas to code.
    stepping,
    drawing,  ///< Writing pictures, frames, logs and files.
    rest,     ///< Everything else.
};
inline constexpr std::size_t spent_count = 7;

class TimeAccount {
public:
    using Clock = std::chrono::steady_clock;

    struct Stage {
        std::string name;
        std::array<double, spent_count> seconds{};  ///< Indexed by Spent.
        std::int64_t steps = 0;
        std::int64_t cells = 0;
        int threads = 1;    ///< The number of threads in the last steps.
        Stepping stepping;  ///< How the last steps divided the planes into tiles and sweeps.
        /// Whether a kernel was interpreted because it could not be compiled.
        bool has_refused = false;
    };

    /// Starts the clock, with the category `rest`.
    TimeAccount();

    /// During its lifetime, adds the time that passes to one category. Scopes may be nested. Does
    /// nothing if the account is null.
    class Scope {
    public:
        /// `stage` is the number of a stage. If it is not given, the time goes to the stage of the
        /// scope around this one.
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

    /// Returns the account of the stage with this number. If there is none yet, adds one.
    Stage& stage(std::uint32_t number);

    /// The numbers of kernels that were compiled or found on disk until the last step was taken.
    KernelCounts kernels;

    const std::vector<Stage>& stages() const { return stages_; }
    /// Returns the seconds of a category so far, in all stages and outside of stages, including the
    /// present scope.
    double seconds(Spent what);
    /// Returns the seconds since the account began, which is the sum of all categories.
    double seconds();
    /// Returns the processor time of the process before the account began, which was mostly spent
    /// on loading libraries.
    double seconds_before() const { return before_; }

private:
    void settle();

    double before_ = 0;
    Clock::time_point since_;
    Spent what_ = Spent::rest;
    std::optional<std::uint32_t> stage_;
    std::array<double, spent_count> outside_{};  ///< Seconds outside of stages, indexed by Spent.
    std::vector<Stage> stages_;
};

}  // namespace cascade
