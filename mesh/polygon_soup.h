// The content of a model file: polygons over points, without adjacency. Guarantees only that every
// corner is one of the points. make_mesh() makes a SurfaceMesh from these polygons.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// A named number at every point: `red`, `quality`, `temperature`.
struct PointAttribute {
    std::string name;
    std::vector<float> values;  ///< One per point.
    // The next two members say how the file represents colours.
    float full = 1;         ///< The value of full light: 255 if the file stores bytes.
    bool is_light = false;  ///< Whether values are proportional to light. Otherwise they are sRGB.

    /// A copy without the values.
    PointAttribute without_values() const { return {name, {}, full, is_light}; }
};

/// Texture coordinates, (0, 0) at the lower left and (1, 1) at the upper right.
using TexturePlace = std::array<float, 2>;

struct PolygonSoup {
    std::vector<Vector3d> points;
    std::vector<std::uint32_t> corners;  ///< Indices of points, one polygon after another.
    std::vector<std::size_t> ends;       ///< Polygon p ends before corners[ends[p]].
    /// One per corner. Empty if the file has no texture coordinates.
    std::vector<TexturePlace> texture;
    std::vector<PointAttribute> attributes;

    std::size_t polygon_count() const { return ends.size(); }
    std::size_t first_corner(std::size_t polygon) const {
        return polygon == 0 ? 0 : ends[polygon - 1];
    }
    std::span<const std::uint32_t> polygon(std::size_t number) const {
        const std::size_t first = first_corner(number);
        return {corners.data() + first, ends[number] - first};
    }
};

}  // namespace cascade
