// Makes the program of a trial run for a stage with a `size`. The trial run has the same equations
// on a separate grid, on which the size of the grown pattern is measured.
#pragma once

#include "lang/program/program.h"

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// The reason why a size cannot be reached, and what users can do.
struct SizeObstacle {
    Span span;
    std::string message;
    std::string hint;
};

/// The program up to `stage`, in which this stage starts and steps on a periodic grid without
/// surface, mask, sides, frozen cells and earlier patterns. Parameters have the values of the
/// stage. A species has the stage's starting value if this has a meaning on any plane, otherwise
/// the system's starting value. The program has the domain's grid, which callers replace. Earlier
/// stages are started but take no steps. Fails if the equations or the parameters depend on
/// positions or on the pattern of an earlier stage.
tl::expected<Program, SizeObstacle> trial_program(const Program& program, std::uint32_t stage);

/// The shortest wavelength, in cells, that a grid can show.
inline constexpr double fewest_cells_of_size = 3;

/// Reports a size below `fewest_cells_of_size` cells or above `most_cells` cells. `cell` is the
/// width of a cell.
std::optional<SizeObstacle> unfit_size(const StageSize& size, double cell, double most_cells);

}  // namespace cascade
