// Remarks on pictures that show less than expected.
#pragma once

#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <string>

namespace cascade {

/// Returns a remark on the final picture of a run, or an empty string. `canvas` is the painter's
/// last canvas. The remark says one of the following: some crawling cells cannot be drawn; the body
/// is empty; the picture has a single colour, because its values are uniform or outside of the
/// requested range; the waves of the stage are too short for the grid. There is no remark if the
/// species themselves are uniform. If remark_on() has a remark on the stage, there is no remark on
/// uniform values and on waves.
std::string remark_on_picture(Painter& painter, const Simulation& simulation, const Canvas& canvas);

/// Returns a remark if a palette or a range was requested for a picture whose formula gives
/// colours, because such a picture uses neither. Otherwise returns an empty string.
std::string remark_on_look(const Painter& painter, const Simulation& simulation,
                           const Canvas& canvas);

/// Returns a remark if the picture block describes a material but the picture shows a body, which
/// has no material. Also returns a remark if the material of a surface or a model has numbers
/// outside of 0 … 1. Otherwise returns an empty string.
std::string remark_on_material(const Script& script, const Canvas& canvas);

}  // namespace cascade
