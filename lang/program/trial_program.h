// The trial run of a stage with a size: the same equations on a plane of their own, where the
// pattern that they grow by themselves can be measured.
#pragma once

#include "lang/program/program.h"

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// Why a size cannot be had, and what to do about it.
struct SizeObstacle {
    Span span;
    std::string message;
    std::string hint;
};

/// The program up to `stage`, in which this stage starts and steps on a periodic grid without
/// surface, mask, sides, frozen cells and earlier patterns. Parameters are those of the stage. A
/// species starts as the stage says if that can be had on any plane, else as its system says. The
/// grid is that of the domain, to be replaced; earlier stages are only started. Fails if the
/// equations or the parameters depend on the place or on the pattern of an earlier stage.
tl::expected<Program, SizeObstacle> trial_program(const Program& program, std::uint32_t stage);

/// Below this number of cells a grid does not show a wave.
inline constexpr double fewest_cells_of_size = 3;

/// Whether a size is below `fewest_cells_of_size` or above `most_cells` cells of this width.
std::optional<SizeObstacle> unfit_size(const StageSize& size, double cell, double most_cells);

}  // namespace cascade
