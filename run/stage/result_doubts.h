// Messages for results that are finite but wrong.
#pragma once

#include "run/stage/step_advice.h"
#include "solvers/solve_report.h"
#include "solvers/stability.h"

#include <optional>
#include <string>

namespace cascade {

/// A warning if the field of a constraint was not found, or could not be; nothing if all is well.
std::optional<std::string> describe(const SolveReport& report, const std::string& unknown,
                                    const std::string& stage);

/// Neighbours that alternate.
struct ChequerboardReport {
    std::string stage, species;
    StepInUse use;
    StabilityEstimate estimate;  ///< At that state.
    bool flickers = false;       ///< Values also jump back and forth from step to step.
};

/// The warning; nothing if neither the step nor a rate that makes differences of neighbours grow
/// explains the alternation, which may then be a lattice.
std::optional<std::string> describe(const ChequerboardReport& report);

/// Values that jump back and forth from step to step.
struct FlickerReport {
    std::string stage, species;
    StepInUse use;
    std::optional<double> limit;  ///< Of the step, if one is known.
    double part = 0;              ///< The part of the cells.
    double largest = 0;           ///< The largest jump.
};

/// The user is warned from this part of the cells on,
inline constexpr double flicker_threshold = 0.01;
/// or from this part of all changes on if steps are too long even for a regular oscillation.
inline constexpr double undone_threshold = 0.4;

/// The warning.
std::string describe(const FlickerReport& report);

/// Values that move differently with shorter steps, if they move at all.
struct AstrayReport {
    std::string stage, species;
    StepInUse use;
    std::optional<double> limit;     ///< Of the step, if one is known.
    std::int64_t steps = 0;          ///< The number of further steps,
    double change = 0;               ///< and how far they move the values (root mean square).
    std::int64_t shorter_steps = 0;  ///< The number of shorter steps that take as long,
    double change_of_shorter = 0;    ///< and how far they move the values.
    double apart = 0;                ///< The distance of the two results.
};

/// The warning.
std::string describe(const AstrayReport& report);

/// Changes that rounding has swallowed.
struct LostChangeReport {
    std::string stage, species;
    double change = 0;  ///< The change in a step, as a mean of magnitudes over the cells;
    double value = 0;   ///< the size of the values to which it is added (root mean square);
    double lost = 0;    ///< the sum of the changes lost in the stage.
};

/// A loss of this part of the values or more is worth a warning.
inline constexpr double lost_change_threshold = 0.01;

/// The warning.
std::string describe(const LostChangeReport& report);

}  // namespace cascade
