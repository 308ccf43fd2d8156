// Runs a stage briefly on a separate plane, to find the factor by which its lengths must be
// multiplied for a wanted wavelength.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "lang/lower/lower.h"
#include "lang/program/program.h"
#include "run/script/script.h"
#include "run/simulation/kernel_maker.h"

#include <cstdint>

namespace cascade {

/// The tools that a trial run shares with the run that needs it.
struct TrialTools {
    const Script& script;  ///< Gives the names of stages for messages.
    StepTools steps;
    PlanOptions planning;
    RunControl& control;  ///< Receives progress and may cancel. A cancelled search fails.
};

/// Returns the factor for with_lengths() that gives the waves of a stage a length of `cells` cells,
/// each `cell` wide. The factor is rounded to four digits, so that errors in the last bits of
/// measurements do not matter. `trial` is the stage's trial_program(). The pattern grows from its
/// own starting values until wavelength and contrast stay the same while the number of steps
/// doubles twice. The first trial uses the stage's own lengths. Later ones use the wanted number of
/// cells, because a coarse grid shortens waves. If a short run cannot hold enough waves of the
/// wanted length, it finds the factor at a shorter length, and theory gives the difference. Fails
/// if no pattern grows, if the pattern keeps changing, or if it has no single wavelength. The
/// result depends neither on the number of threads nor on the width of vectors.
Result<double> find_length_factor(const Program& trial, std::uint32_t stage, double cell,
                                  double cells, const TrialTools& tools);

/// The most steps of a trial, for a stage whose end is given in steps.
std::int64_t trial_steps(const Program& trial, std::uint32_t stage);

}  // namespace cascade
