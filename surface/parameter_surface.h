// Surfaces given by a function of two parameters: torus, cylinder, vase, sheared sheet. The grid
// covers the square of the parameters. The metric describes how the surface stretches cells.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "core/result.h"

#include <array>
#include <functional>
#include <optional>

namespace cascade {

/// A point in space, in the unit of the user's function.
using Position = std::array<double, 3>;

/// Maps the point (sx, sy) of the square 0..1 × 0..1 into space.
using SurfaceFunction = std::function<Position(double sx, double sy)>;

/// The metric in each cell: the cell's area, and the inverse of the matrix Ṽ of A. Witkin and M.
/// Kass, "Reaction-Diffusion Textures" (1991), equation 8. Ṽ maps steps of one column and one row
/// to lengths along two perpendicular directions of the tangent plane, the first along a row of
/// cells:
///
///     Ṽ⁻¹ = | inverse_11  inverse_12 |      A tensor A in those directions is Ṽ⁻¹ A Ṽ⁻ᵀ in
///           |     0       inverse_22 |      columns and rows. (The paper's last step prints ṼᵀAṼ.)
///
/// The default unit of length is √(area of the surface / number of cells). Patterns are then as
/// large, measured in cells, as with the same script in the plane. If `detail` divides cells, the
/// number of undivided cells counts.
struct SurfaceMetric {
    Field inverse_11, inverse_12, inverse_22;  ///< The elements of Ṽ⁻¹, in cells per unit.
    Field area;                                ///< The cell's area s, in square units.
    /// The elements of s Ṽ⁻¹ Ṽ⁻ᵀ, which maps differences to flows.
    Field flow_11, flow_12, flow_22;
    double unit = 0;  ///< The unit of length, in units of the function.
};

/// Measures the surface at the centre of every cell, by central differences in binary64. Rounds
/// fields to `precision`. `unit`, which must be positive, is the length of one unit in units of the
/// function. Fails with the location if the surface is not finite, or has no area because its two
/// directions are parallel or one of them is 0.
Result<SurfaceMetric> measure_surface(const SurfaceFunction& surface, const Grid& grid,
                                      std::optional<double> unit,
                                      Precision precision = Precision::single,
                                      std::int64_t detail = 1);

}  // namespace cascade
