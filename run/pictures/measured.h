// Measures the features of the number that a picture shows.
#pragma once

#include "core/plane.h"
#include "measure/features.h"
#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Returns the number in a picture, in all cells. In a volume, these are the cells of all slices.
/// If the picture shows colours, returns the number that the stage shows by default: the setting
/// `show` of its system or, if it is missing, its last species.
Field shown_number(Painter& painter, const Simulation& simulation);

/// Returns the name of shown_number() in figures: the text of `--show`, or the species that the
/// stage shows by default. Returns an empty string if the number has no name.
std::string name_of_number(const Script& script, std::uint32_t stage,
                           const PictureRequest& request);

/// Measures the features of shown_number(). On a model and for crawling cells, there are no rows
/// and columns, so only the mean, deviation, smallest and largest value are measured.
measure::Features measure_shown(Painter& painter, const Simulation& simulation);

/// Measures the characteristic length of shown_number() (measure/spectrum.h). Returns NaN if the
/// number is uniform, on a model, and for crawling cells.
double shown_length(Painter& painter, const Simulation& simulation);

}  // namespace cascade
