// Which place of a surface lies where in its texture: triangles drawn into the plane of their
// texture coordinates.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A texture of `width` × `height` samples, its rows counted from the top, that repeats in all
/// directions. Safe to use from several threads at once.
class TextureLayout {
public:
    TextureLayout(const SurfaceMesh& mesh, std::int64_t width, std::int64_t height);

    std::int64_t width() const { return width_; }
    std::int64_t height() const { return height_; }

    /// Triangles that cannot be drawn.
    struct Skipped {
        std::size_t without_area = 0;  ///< In the texture.
        std::size_t without_place =
            0;  ///< Coordinates that are not finite or beyond ±largest_place.
    };
    const Skipped& skipped() const { return skipped_; }
    /// Of all triangles together, in areas of the texture; above 1 they must overlap.
    double covered_area() const { return covered_area_; }
    static constexpr float largest_place = 256;

    /// Finds what lies at the middles of samples in rows first … last − 1: row by row the number of
    /// the triangle, `nothing` where there is none, the first one where there are several. A sample
    /// on the edge between two triangles is in one of them. Returns how often a sample is in a
    /// further triangle. `owners` has (last − first) · width() elements.
    std::int64_t find_owners(std::int64_t first, std::int64_t last,
                             std::span<std::uint32_t> owners) const;
    static constexpr std::uint32_t nothing = 0xffffffff;

    /// The place of a triangle at the middle of a sample which find_owners found in it.
    SurfacePlace place_at(std::uint32_t triangle, std::int64_t column, std::int64_t row) const;

private:
    /// A triangle in units of samples, y growing downwards.
    struct Drawn {
        FlatTriangle corners;
        double sign = 0;                   ///< Of its area; 0: it is not drawn.
        std::int64_t first = 0, last = 0;  ///< Its rows, as if the texture did not repeat.
    };
    /// How far a point lies inside of each edge, if it is in the triangle. Of two triangles that
    /// share an edge exactly one has the points on it.
    static bool holds(const Drawn& triangle, Vector2d point, std::array<double, 3>& inside);
    template <typename Visit>
    static void visit_columns(const Drawn& triangle, std::int64_t row, const Visit& visit);

    std::int64_t width_ = 1, height_ = 1;
    std::vector<Drawn> triangles_;
    Skipped skipped_;
    double covered_area_ = 0;
};

}  // namespace cascade
