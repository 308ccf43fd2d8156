// Puts the values of a run into the slots of a bound kernel.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "ir/backend.h"
#include "lang/lower.h"
#include "run/input_files.h"
#include "run/simulation.h"
#include "solvers/advance.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Where slots find their values.
struct BindingContext {
    std::span<const StageState> states;
    const InputFiles& files;
    std::int64_t steps = 0;   ///< Complete steps of the stage the kernel belongs to.
    Grid grid;
};

/// Runs a kernel once over a grid, its rows shared by the team; one field per result.
std::vector<Field> run_once(const Kernel& kernel, const BoundKernel& bound,
                            const BindingContext& context, const Grid& on, Team& team);

/// A step (or rates) kernel of `stage` with all its slots but the species, for the time loop.
StepProblem bind_step(const BoundKernel& bound, KernelPointer kernel,
                      const BindingContext& context, const System& system, std::uint32_t stage);

/// 1 where the value is not 0 (NaN counts as not 0, as everywhere in the language).
Mask to_mask(const Field& field);

/// The smallest value of a field's cells; NaN if one is NaN.
float smallest(const Field& field);

/// The name of species number `species`.
std::string species_name(const System& system, std::size_t species);

}  // namespace cascade
