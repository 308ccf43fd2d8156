// Features of a picture's number, measured by measure/.
#pragma once

#include "core/plane.h"
#include "measure/features.h"
#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The number in a picture, in all cells, also of a volume. For a colour it is the number that the
/// stage shows by default (its `show`, or its last species).
Field shown_number(Painter& painter, const Simulation& simulation);

/// Its name in figures: the text of `--show`, or the species that the stage shows by default. Empty
/// if it has none.
std::string name_of_number(const Script& script, std::uint32_t stage,
                           const PictureRequest& request);

/// The features of shown_number(). Without rows and columns of cells, on a model and for crawling
/// cells, only mean, deviation, smallest and largest are numbers.
measure::Features measure_shown(Painter& painter, const Simulation& simulation);

}  // namespace cascade
