// Remarks on pictures that show less than expected.
#pragma once

#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <string>

namespace cascade {

/// A remark on the final picture of a run, or an empty text. `canvas` is the painter's last canvas.
/// The remark says that the picture has a single colour because its values are uniform or outside
/// of the requested range. It may instead say that the waves of the stage are too short for the
/// grid, if remark_on() has no remark on the stage. Empty if the species themselves are uniform.
std::string remark_on_picture(Painter& painter, const Simulation& simulation, const Canvas& canvas);

/// A remark if a palette or a range was requested for a picture whose formula gives colours,
/// because such a picture uses neither. Otherwise empty.
std::string remark_on_look(const Painter& painter, const Simulation& simulation,
                           const Canvas& canvas);

/// A remark if the picture block describes a material but the picture shows a body, which has none.
/// Also a remark if the material of a surface or a model has numbers outside of 0 … 1. Otherwise
/// empty.
std::string remark_on_material(const Script& script, const Canvas& canvas);

}  // namespace cascade
