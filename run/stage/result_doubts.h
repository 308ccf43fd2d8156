// Words for results that are finite and all the same wrong.
#pragma once

#include "run/stage/step_advice.h"
#include "solvers/stability.h"

#include <optional>
#include <string>

namespace cascade {

/// Neighbours that alternate.
struct ChequerboardReport {
    std::string stage, species;
    StepInUse use;
    StabilityEstimate estimate;  ///< At that state.
    bool flickers = false;       ///< Values jump back and forth from step to step, too.
};

/// The warning; nothing where neither the step nor a rate that makes differences of neighbours grow
/// explains it, as where a lattice is meant.
std::optional<std::string> describe(const ChequerboardReport& report);

/// Values that jump back and forth from step to step.
struct FlickerReport {
    std::string stage, species;
    StepInUse use;
    std::optional<double> limit;  ///< Of the step, where one is known.
    double part = 0;              ///< Of the cells.
    double largest = 0;           ///< Jump.
};

/// From this part of the cells on the user is warned.
inline constexpr double flicker_threshold = 0.01;
/// From this part of all changes on, in steps too long for a regular to and fro.
inline constexpr double undone_threshold = 0.4;

/// The warning.
std::string describe(const FlickerReport& report);

/// Values that steps lead another way than shorter ones would, if they move at all.
struct AstrayReport {
    std::string stage, species;
    StepInUse use;
    std::optional<double> limit;     ///< Of the step, where one is known.
    std::int64_t steps = 0;          ///< So many further steps
    double change = 0;               ///< move the values by so much (root mean square),
    std::int64_t shorter_steps = 0;  ///< The number of shorter steps that take as long.
    double change_of_shorter = 0;    ///< by so much,
    double apart = 0;                ///< to values that differ by so much.
};

/// The warning.
std::string describe(const AstrayReport& report);

/// Changes that rounding has swallowed.
struct LostChangeReport {
    std::string stage, species;
    double change = 0;  ///< What a step would add, on average over the cells in magnitude,
    double value = 0;   ///< to values of this size (root mean square);
    double lost = 0;    ///< so much over the stage.
};

/// From this part of the values on, what is lost is worth a warning.
inline constexpr double lost_change_threshold = 0.01;

/// The warning.
std::string describe(const LostChangeReport& report);

}  // namespace cascade
