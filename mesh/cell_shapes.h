// Shapes that cells of tissues may have: balls, plates (scales), thorns, tufts of hair, feathers.
//
// The y axis points away from the surface on which a cell sits, z is the direction of its combing
// and x is across. The base is at the origin. Lengths are in the cell's radius along x and z, and
// in its height along y.
#pragma once

#include "core/result.h"
#include "mesh/swept_shape.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cascade {

struct CellShape {
    enum class Kind : std::uint8_t {
        ball,   ///< A ball (an ellipsoid if the height is not the radius), half of it below y = 0.
        plate,  ///< A scale: round in front, pointed at the rear, where it covers the next one.
        thorn,  ///< A bump that becomes a thorn.
        hair,   ///< A tuft of 14 blades.
        feather,  ///< A vane with barbs on both sides of a shaft.
    };
    Kind kind = Kind::ball;
    double form = 1;    ///< Of a thorn, 0 … 1: from a bump to a thorn.
    double bend = 0.5;  ///< 0 … 1, towards z. Plates and feathers are raised the less.
};

/// The kinds by name, "ball" first.
struct NamedCellShape {
    std::string_view name;
    CellShape::Kind kind;
};
std::span<const NamedCellShape> cell_shapes();
std::optional<CellShape::Kind> find_cell_shape(std::string_view name);

/// A closed part of a shape.
struct ShapePart {
    SweptSurface surface;
    SweptNumber shade;
};
std::vector<ShapePart> parts_of(const CellShape& shape);

/// The parts as one mesh, each with facets_for() the detail. Fails as that and swept_shape() do.
Result<TriangleMesh> mesh_of(std::span<const ShapePart> parts, const SweptDetail& detail);

}  // namespace cascade
