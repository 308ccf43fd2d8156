// Values between the cells of a surface: what is known at their places, averaged so smoothly that
// no cell is seen.
//
// G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis, 1992), section 5.4.1: the value
// at a place is the average of those of the cells around it, each with the weight
//
//     w(d / s) = 2 (d / s)³ − 3 (d / s)² + 1    for d < s, and 0 beyond.
//
// Turk takes d in space and s = 2 r; here d runs along the surface where that is longer, so that
// the two sides of a leaf have nothing to do with each other, and s is the radius of repulsion r =
// 2 √(area / cells), which takes in a dozen cells.
#pragma once

#include "core/parallel.h"
#include "surface/cell_images.h"
#include "surface/voronoi_cells.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// How much of a cell is seen at a place.
struct CellShare {
    std::uint32_t cell = 0;
    float weight = 0;
};

/// The same, with its change along the surface, in the plane of the triangle, per radius of the
/// filter.
struct SlopedShare {
    std::uint32_t cell = 0;
    float weight = 0;
    Vector3 slope;
};

/// Safe to use from several threads at once. It keeps nothing of the cells and needs the mesh no
/// longer than its constructor runs.
class CellFilter {
public:
    /// Finds out from where each cell is seen. There is at least one cell. The same on any number
    /// of threads. Throws std::bad_alloc.
    CellFilter(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);

    /// The cells near a place, by their numbers, with weights ≥ 0 that sum to 1. There is always
    /// one: where none is near it is the nearest, along the surface if its component has cells.
    /// Replaces `out`.
    void shares(const SurfacePlace& place, std::vector<CellShare>& out) const;

    /// The same cells with slopes that sum to 0, true to some hundredths where the surface is
    /// curved.
    void sloped_shares(const SurfacePlace& place, std::vector<SlopedShare>& out) const;

    /// s: no cell farther than this has a share.
    double radius() const { return radius_; }

private:
    /// A triangle laid flat, its longest edge along the x axis from the origin. Lengths are in
    /// units of the radius, boxes are one wide and high.
    struct Patch {
        Vector3 origin;
        Vector3 x_axis, y_axis;                        ///< In space, of length 1.
        float second_x = 0, third_x = 0, third_y = 0;  ///< Of the corners.
        std::uint32_t first_corner = 0;                ///< Which one is the origin.
        std::uint32_t columns = 1, rows = 1;
        std::uint32_t otherwise = 0;  ///< The cell that is taken if there is none.
        std::size_t first_box = 0;
    };
    /// Where a cell is seen near some edges of a triangle, unfolded into its plane.
    struct Sighting {
        std::uint32_t cell = 0;
        std::uint32_t edges = 0;  ///< A bit for each of the three.
        float x = 0, y = 0;
    };
    /// A cell within the radius.
    struct Near {
        std::uint32_t cell = 0;
        float square = 0;    ///< Of its distance.
        float x = 0, y = 0;  ///< From it to the place.
    };
    struct FlatPoint {
        float x = 0, y = 0;
        std::array<float, 3> edges{};  ///< How near they are: 1 on an edge, and together 1.
    };
    /// What an image is in the boxes.
    struct Sightings {
        std::array<Sighting, 3> all;
        std::size_t count = 0;
    };

    static FlatPoint flat_point(const Patch& patch, const SurfacePlace& place);
    static std::size_t box_of(const Patch& patch, FlatPoint place);
    std::span<const Sighting> sightings_of(std::size_t first_box, std::size_t boxes) const;
    template <typename Visit>
    void visit_near(const Patch& patch, FlatPoint place, const Visit& visit) const;
    std::uint32_t nearest_cell(const Patch& patch, FlatPoint place) const;
    void lay_out(const SurfaceMesh& mesh, const SurfaceCells& cells);
    void fill_boxes(std::span<const CellImage> images);
    static Sightings sightings_in(const CellImage& image);
    template <typename Visit>
    void visit_boxes(const CellImage& image, const Visit& visit) const;
    void find_substitutes(const SurfaceMesh& mesh, const SurfaceCells& cells);

    double radius_ = 0;
    std::vector<Vector3> positions_;     ///< Of the cells in space, from the first one.
    std::vector<Patch> patches_;         ///< One a triangle.
    std::vector<std::size_t> box_ends_;  ///< Box b's sightings end before sightings_[box_ends_[b]].
    std::vector<Sighting> sightings_;    ///< In each box by the numbers of the cells.
};

}  // namespace cascade
