// Remarks on pictures that show less than expected.
#pragma once

#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <string>

namespace cascade {

/// A sentence about the final picture of a run, with the painter's last canvas, or "". Says that it
/// has a single colour because its values are outside of the requested range or uniform, or, if
/// there is no other remark on the stage (Simulation::remark_on), that its waves are too short for
/// the grid. "" if the species themselves are uniform.
std::string remark_on_picture(Painter& painter, const Simulation& simulation, const Canvas& canvas);

/// A sentence if a palette or a range was requested for a picture made of colours, which ignores
/// them. Otherwise "".
std::string remark_on_look(const Painter& painter, const Simulation& simulation,
                           const Canvas& canvas);

}  // namespace cascade
