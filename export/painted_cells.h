// The appearance of cells at any point of the surface.
#pragma once

#include "core/palette.h"
#include "core/parallel.h"
#include "export/material.h"
#include "surface/cell_filter.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// The colour (sRGB) for the values of all channels at a point. Must be thread-safe and not throw.
using PlaceColour = std::function<Colour(std::span<const float> values, const SurfacePlace& place)>;

/// The same for many points, if colours depend only on the values. All results are shown().
using ValueColours = std::function<void(std::span<const float> values, std::span<Colour> colours)>;

/// Values to paint and their mapping to colours. Its references must outlive it.
struct PaintedCells {
    std::size_t channels = 1;
    std::span<const float> values;  ///< `channels` per cell, cell after cell.
    /// If a channel of a colour is NaN, the colour of NaN is used.
    PlaceColour colour;
    /// One per cell: its height above the surface, in the unit of the mesh. Empty: no heights.
    std::span<const float> heights;
    MaterialCells material = {};
    bool displaces = false;     ///< Heights move the surface in pictures.
    ValueColours colours = {};  ///< Faster for many points; may be left out.
};

/// Paints points of the surface. Not thread-safe.
class PlacePainter {
public:
    PlacePainter(const CellFilter& filter, const PaintedCells& cells);

    struct Look {
        Colour colour;
        float height = 0;
        OfParts<float> material{};  ///< The parts that cells have.
    };
    /// The colour of the filtered values, the filtered height and material.
    Look at(const SurfacePlace& place);
    /// The two halves of `at`. The first gives the filtered values, followed by the material's and
    /// the height, which vary smoothly along the surface, and the second their look. `values` has
    /// number_of_values() elements.
    void filter_at(const SurfacePlace& place, std::span<float> values);
    Look look_of(std::span<const float> values, const SurfacePlace& place) const;
    std::size_t number_of_values() const { return cells_.channels + parts_.size() + 1; }

    /// The gradient of the height, in the plane of the triangle. Exactly 0 if all heights around
    /// are equal.
    Vector3d rise_at(const SurfacePlace& place);

private:
    const CellFilter& filter_;
    const PaintedCells& cells_;
    std::vector<MaterialPart> parts_;  ///< The parts that cells have.
    std::vector<float> values_;
    std::vector<CellShare> shares_;
    std::vector<SlopedShare> slopes_;
};

/// The same with emission converted to linear light.
OfParts<float> in_light(OfParts<float> material);

/// A vector along the normal of a surface with this normal that is raised by small heights with
/// this gradient (J. Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978).
inline Vector3d raised(Vector3d normal, Vector3d rise) {
    return normal - (rise - normal * dot(rise, normal));
}

/// The colours at points of the surface. The same on any number of threads. Throws std::bad_alloc.
std::vector<Colour> colours_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               const PaintedCells& cells, Team& team);

}  // namespace cascade
