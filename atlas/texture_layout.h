// The mapping from a texture to surface positions: triangles rasterised in texture coordinates.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A repeating texture of `width` × `height` samples, rows from the top. Thread-safe.
class TextureLayout {
public:
    TextureLayout(const SurfaceMesh& mesh, std::int64_t width, std::int64_t height);

    std::int64_t width() const { return width_; }
    std::int64_t height() const { return height_; }

    /// Triangles that cannot be drawn.
    struct Skipped {
        std::size_t without_area = 0;   ///< In the texture.
        std::size_t without_place = 0;  ///< Not finite, or beyond ±largest_place.
    };
    const Skipped& skipped() const { return skipped_; }
    /// The total area of all triangles, in areas of the texture. Above 1 they must overlap.
    double covered_area() const { return covered_area_; }
    /// The part of that area in triangles whose picture is mirrored.
    double mirrored_part() const { return covered_area_ > 0 ? mirrored_area_ / covered_area_ : 0; }
    /// Whether a triangle has samples beyond 0 … 1, where the texture repeats.
    bool repeats() const { return repeats_; }
    static constexpr float largest_place = 256;

    /// Finds the triangles at the centres of samples in rows first … last − 1, row by row: the
    /// first triangle if there are several, `nothing` if there is none. A sample on the edge
    /// between two triangles is in one of them. `owners` has (last − first) · width() elements.
    struct Overlap {
        std::int64_t again = 0;   ///< The number of further triangles, over all samples.
        std::int64_t shared = 0;  ///< The number of samples in several triangles.
    };
    Overlap find_owners(std::int64_t first, std::int64_t last,
                        std::span<std::uint32_t> owners) const;
    static constexpr std::uint32_t nothing = 0xffffffff;

    /// The surface position at the centre of a sample, in the triangle found by find_owners().
    SurfacePlace place_at(std::uint32_t triangle, std::int64_t column, std::int64_t row) const;

private:
    /// A triangle in units of samples, with y down.
    struct Drawn {
        FlatTriangle corners;
        double sign = 0;                   ///< The sign of its area. 0 if it is not drawn.
        std::int64_t first = 0, last = 0;  ///< Its rows, without wrapping.
        /// The repetitions of the texture that it touches.
        std::int64_t top = 0, bottom = 0, left = 0, right = 0;
    };
    /// Whether a point is in the triangle, and its distances from the edges. Of two triangles with
    /// a common edge exactly one contains the points on it.
    static bool holds(const Drawn& triangle, Vector2d point, std::array<double, 3>& inside);
    template <typename Visit>
    static void visit_columns(const Drawn& triangle, std::int64_t row, const Visit& visit);

    std::int64_t width_ = 1, height_ = 1;
    std::vector<Drawn> triangles_;
    Skipped skipped_;
    double covered_area_ = 0, mirrored_area_ = 0;
    bool repeats_ = false;
};

}  // namespace cascade
