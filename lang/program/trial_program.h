// Makes the program of a trial run for a stage with a `size`. The trial run computes the same
// equations on a separate grid, on which the size of the grown pattern is measured.
#pragma once

#include "lang/program/program.h"

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// Why a size cannot be reached, and what users can do about it.
struct SizeObstacle {
    Span span;
    std::string message;
    std::string hint;
};

/// The program up to `stage`, in which this stage starts and steps on a periodic grid without
/// surface, mask, sides, frozen cells and earlier patterns. Parameters have the values of the
/// stage. A species has the starting value of the stage if this value has a meaning on every plane.
/// Otherwise it has the starting value of the system. The program has the grid of the domain, which
/// callers must replace. Earlier stages are started but take no steps. Fails if the equations or
/// the parameters depend on positions or on the pattern of an earlier stage.
tl::expected<Program, SizeObstacle> trial_program(const Program& program, std::uint32_t stage);

/// The shortest wavelength, in cells, that a grid can represent.
inline constexpr double fewest_cells_of_size = 3;

/// Returns an obstacle if the size is less than `fewest_cells_of_size` cells or more than
/// `most_cells` cells. `cell` is the width of a cell.
std::optional<SizeObstacle> unfit_size(const StageSize& size, double cell, double most_cells);

}  // namespace cascade
