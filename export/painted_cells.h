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

/// Computes the colour (sRGB) at a point from the values of all channels there. Must be thread-safe
/// and not throw.
using PlaceColour = std::function<Colour(std::span<const float> values, const SurfacePlace& place)>;

/// Computes the colours of many points at once. Only possible if colours depend on nothing but
/// values. Applies shown() to the results.
using ValueColours = std::function<void(std::span<const float> values, std::span<Colour> colours)>;

/// The values to paint, and how to compute colours from them. Refers to its parts, which must
/// outlive it.
struct PaintedCells {
    std::size_t channels = 1;
    std::span<const float> values;  ///< `channels` values per cell, cell after cell.
    /// Gives the colour of a point. If a channel of this colour is NaN, the colour that represents
    /// NaN is painted instead.
    PlaceColour colour;
    /// For each cell, its height above the surface, in the unit of the mesh. Empty if there are no
    /// heights.
    std::span<const float> heights;
    MaterialCells material = {};
    bool displaces = false;  ///< Whether heights displace the surface in pictures.
    ValueColours colours =
        {};  ///< A faster way to compute the colours of many points, if there is one.
};

/// Paints points of the surface. Not thread-safe.
class PlacePainter {
public:
    PlacePainter(const CellFilter& filter, const PaintedCells& cells);

    struct Look {
        Colour colour;
        float height = 0;
        OfParts<float> material{};  ///< Only the parts that the cells have are set.
    };
    /// The filtered height and material at a point, and the colour of the filtered values.
    Look at(const SurfacePlace& place);
    /// The two steps of at(). filter_at() computes the filtered values, material and height, which
    /// vary smoothly along the surface. look_of() computes the appearance from them. `values` has
    /// number_of_values() elements.
    void filter_at(const SurfacePlace& place, std::span<float> values);
    Look look_of(std::span<const float> values, const SurfacePlace& place) const;
    std::size_t number_of_values() const { return cells_.channels + parts_.size() + 1; }

    /// The gradient of the height at a point, in the plane of its triangle. Exactly 0 if all
    /// heights around the point are equal.
    Vector3d rise_at(const SurfacePlace& place);

private:
    const CellFilter& filter_;
    const PaintedCells& cells_;
    std::vector<MaterialPart> parts_;  ///< The parts of the material that the cells have.
    std::vector<float> values_;
    std::vector<CellShare> shares_;
    std::vector<SlopedShare> slopes_;
};

/// The material with emission converted to linear light.
OfParts<float> in_light(OfParts<float> material);

/// A vector along the normal of a raised surface. `normal` is the normal of the surface below, and
/// `rise` the gradient of its small heights (J. Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH
/// 1978).
inline Vector3d raised(Vector3d normal, Vector3d rise) {
    return normal - (rise - normal * dot(rise, normal));
}

/// The colours at points of the surface. The result is the same with any number of threads. Throws
/// std::bad_alloc.
std::vector<Colour> colours_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               const PaintedCells& cells, Team& team);

}  // namespace cascade
