// Computes the growth of a domain from its lengths, which are formulas of time.
#pragma once

#include "core/grid.h"
#include "lang/program/growth.h"

#include <optional>
#include <span>

namespace cascade {

/// The growth of a domain with the given lengths along x, y and z, which are formulas of numbers
/// and `t`. Axes without a given length grow like the first axis. The dilution is the sum of the
/// logarithmic derivatives of the lengths. nullopt if there is no rule for the derivative of a
/// length. The caller must set `written` and `span`.
std::optional<Growth> growth_of(std::span<const Formula> lengths, const Grid& grid);

/// The growth of a surface or model whose longest side has this length, a formula of numbers and
/// `t`. The scale of lengths is 1 where the side is `start` long. The surface grows alike in all
/// directions, so amounts are diluted at twice the rate of a length. Otherwise as growth_of().
std::optional<Growth> growth_of_surface(const Formula& extent, double start);

}  // namespace cascade
