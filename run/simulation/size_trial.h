// Runs a stage for a short time on a separate grid. From the result, finds the factor by which the
// stage's lengths must be multiplied so that its waves have a wanted length.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "lang/lower/lower.h"
#include "lang/program/program.h"
#include "run/script/script.h"
#include "run/simulation/kernel_maker.h"

#include <cstdint>

namespace cascade {

/// The tools that a trial run shares with the run for which it is made.
struct TrialTools {
    const Script& script;  ///< Contains the names of stages for messages.
    StepTools steps;
    PlanOptions planning;
    RunControl& control;  ///< Receives progress and may cancel. A cancelled search fails.
};

/// Returns the factor for with_lengths() with which the waves of a stage have a length of `cells`
/// cells, each `cell` wide. The factor is rounded to four digits, so that errors in the last bits
/// of measurements do not matter. `trial` is the stage's trial_program(). The pattern grows from
/// the stage's own starting values. A trial run ends when wavelength and contrast have stayed the
/// same while the number of steps has doubled twice. The first trial uses the stage's own lengths.
/// Later trials use waves with the wanted number of cells, because a coarse grid shortens waves. If
/// waves of the wanted length are so long that too few of them fit into a short run, the factor is
/// found for shorter waves, and theory gives the difference. Fails if no pattern grows, if the
/// pattern keeps changing, or if it has no single wavelength. The result depends neither on the
/// number of threads nor on the width of vectors.
Result<double> find_length_factor(const Program& trial, std::uint32_t stage, double cell,
                                  double cells, const TrialTools& tools);

/// Returns the largest number of steps of a trial, for a stage whose end is given in steps.
std::int64_t trial_steps(const Program& trial, std::uint32_t stage);

}  // namespace cascade
