// What is to be said of a picture: where it shows less than one would think.
#pragma once

#include "run/pictures/painter.h"
#include "run/simulation/simulation.h"

#include <string>

namespace cascade {

/// One sentence about the final picture of a run, or nothing: that it is of one colour, because all
/// it shows lies beside the range that was asked for, or is even; or, where there is nothing to be
/// said of the stage that is shown (Simulation::remark_on), that its waves are too short for the
/// grid, or most of what the stage has made is finer than the grid can hold. Nothing where the
/// species themselves are even, or the stage's result has been doubted already.
std::string remark_on_picture(Painter& painter, const Simulation& simulation);

/// That a palette or a range was asked for and the picture, being made of colours, has no use for
/// it.
std::string remark_on_look(Painter& painter, const Simulation& simulation);

}  // namespace cascade
