// Records how the time of a run is spent, for the option `--timing`.
//
// Only the thread of the run records times. A nested scope pauses the outer one. So each moment is
// counted once, and the parts add up to the whole.
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
    /// Making the cells of a model, and the values that formulas read at positions on it.
    cells,
    starting,   ///< Computing starting values, masks and step-invariants.
    compiling,  ///< Compiling kernels: from checked formulas to code.
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

    /// During its lifetime, adds the time to one category. Scopes may be nested. Does nothing if
    /// the account is null.
    class Scope {
    public:
        /// `stage` is the number of a stage. Without one, the time goes to the stage of the
        /// enclosing scope.
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

    /// The account of the stage with this number, which is added if it is new.
    Stage& stage(std::uint32_t number);

    /// The numbers of kernels that were compiled or found on disk, up to the last step.
    KernelCounts kernels;

    const std::vector<Stage>& stages() const { return stages_; }
    /// Seconds of a category so far, in all stages and outside of them, including the present
    /// scope.
    double seconds(Spent what);
    /// Seconds since the account began, which is the sum of all categories.
    double seconds();
    /// Processor time of the process before the account began, mostly for loading libraries.
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
