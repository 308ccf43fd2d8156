// Short runs of a stage on a plane of its own, which find by how much its lengths must be scaled so
// that its pattern has a wanted wavelength.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "lang/lower/lower.h"
#include "lang/program/program.h"
#include "run/script/script.h"
#include "run/simulation/kernel_maker.h"

#include <cstdint>

namespace cascade {

/// What trial runs have in common with the run that needs them.
struct TrialTools {
    const Script& script;  ///< For the names of its stages in messages.
    StepTools steps;
    PlanOptions planning;
    RunControl& control;  ///< Receives progress and may cancel; the result is then a failure.
};

/// The factor for with_lengths() by which a wave gets `cells` cells of width `cell`; rounded to
/// four digits, so that last bits of measurements do not matter. `trial` is trial_program() of the
/// stage. It grows from its own starting values until wavelength and contrast hold still while the
/// number of steps doubles twice, first with its lengths as they are, then at the wanted number of
/// cells, because a coarse grid makes waves shorter. Waves of more cells than a short run can hold
/// are found at fewer, with the theory of the difference. Fails if no pattern grows, if it never
/// holds still, or if it has no single wavelength. The same with any number of threads and any
/// vectors.
Result<double> find_length_factor(const Program& trial, std::uint32_t stage, double cell,
                                  double cells, const TrialTools& tools);

/// The most steps of a trial of a stage that ends by its steps.
std::int64_t trial_steps(const Program& trial, std::uint32_t stage);

}  // namespace cascade
