// Values of sides that change: collects the values that their formulas read along the side.
#pragma once

#include "core/parallel.h"
#include "lang/lower/lower.h"
#include "run/stage/bound_kernel.h"
#include "solvers/changing_side.h"

namespace cascade {

/// The value of a side of species number `species` of a stage, ready to be computed for any moment.
/// The parts that do not depend on the moment are computed here, from the present state.
ChangingSide bind_side(const SidePlans& plans, std::uint32_t stage, SpeciesId species, Side side,
                       const Compile& compile, const BindingContext& context, Team& team);

}  // namespace cascade
