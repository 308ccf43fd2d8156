// From the fields of a run to what measure/ takes.
#pragma once

#include "core/plane.h"
#include "measure/features.h"
#include "run/picture_request.h"
#include "run/simulation.h"

namespace cascade {

measure::Samples to_samples(const Field& field, const Grid& grid);

/// The features of the number that a picture shows, over all cells (also of a volume). A colour is
/// no number: then those of what the stage shows by default (its `show`, or its last species).
measure::Features measure_shown(Painter& painter, const Simulation& simulation);

}  // namespace cascade
