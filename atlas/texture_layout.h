// Maps a texture to positions on a surface, by rasterising triangles in texture coordinates.
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
        std::size_t without_area = 0;  ///< Number of triangles without area in the texture.
        /// Number of triangles whose coordinates are not finite, or are beyond ±largest_place.
        std::size_t without_place = 0;
    };
    const Skipped& skipped() const { return skipped_; }
    /// The total area of all triangles, as a multiple of the texture's area. Above 1, the triangles
    /// cannot all fit without overlaps.
    double covered_area() const { return covered_area_; }
    /// The fraction of covered_area() that belongs to mirrored triangles.
    double mirrored_part() const { return covered_area_ > 0 ? mirrored_area_ / covered_area_ : 0; }
    /// Whether a triangle has samples beyond 0 … 1, where the texture repeats.
    bool repeats() const { return repeats_; }
    static constexpr float largest_place = 256;

    /// Finds, row by row, the first triangle at the centre of each sample in rows first … last − 1,
    /// or `nothing` if no triangle is there. A sample on the edge between two triangles is in one
    /// of them. `owners` has (last − first) · width() elements.
    struct Overlap {
        /// The number of triangles at a sample in addition to the first, summed over all samples.
        std::int64_t again = 0;
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
        double sign =
            0;  ///< 1 or −1: the sign of the triangle's area. 0 if the triangle is not drawn.
        std::int64_t first = 0, last = 0;  ///< The triangle's rows, without wrapping.
        /// The repetitions of the texture that the triangle touches.
        std::int64_t top = 0, bottom = 0, left = 0, right = 0;
    };
    /// Whether a point is in the triangle. Also sets `inside` to the point's distances from the
    /// edges. If two triangles have a common edge, exactly one of them contains the points on it.
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
