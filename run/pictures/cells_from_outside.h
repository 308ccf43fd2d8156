// Finds what is visible from outside: a point of a surface, or an object on the surface. From these
// points, maps are made. With such maps, the surface alone looks from a distance like the surface
// with its objects.
#pragma once

#include "export/painted_cells.h"
#include "export/sample_painter.h"
#include "mesh/instances.h"
#include "mesh/normals.h"
#include "render/ray_caster.h"
#include "run/domain/creased_mesh.h"

#include <optional>

namespace cascade {

/// Finds the objects above points of a surface by tracing rays inwards along the smooth normals of
/// the surface. A ray begins at the height of the highest object or, if another part of the surface
/// is near, half-way to that part. Any thread may use this object. The mesh must outlive it.
class CellsFromOutside {
public:
    /// Copies must be in the coordinates of the mesh. Throws std::bad_alloc.
    CellsFromOutside(const SurfaceMesh& mesh, Instances copies);
    CellsFromOutside(const CellsFromOutside&) = delete;
    CellsFromOutside& operator=(const CellsFromOutside&) = delete;

    struct Thing {
        /// The reflected fractions of red, green and blue light, 0 … 1 (see light_of()).
        Colour light{};
        double height = 0;  ///< The height above the surface, in lengths of the mesh.
        Vector3d normal;    ///< The normal of the visible surface, of length 1.
    };
    /// Returns the outermost object above a position of the surface. Returns an empty optional if
    /// there is no object.
    std::optional<Thing> above(const SurfacePlace& place) const;

private:
    const SurfaceMesh& mesh_;
    CornerNormals normals_;
    DrawnMesh drawn_;
    /// The copies in the coordinates of the drawn mesh, in which all lengths below are given, too.
    Instances copies_;
    float farthest_ = 0;
    std::optional<RayCaster> of_surface_, of_copies_;  ///< Empty if there are no copies.
};

/// The colours of the surface below the objects: a single colour, or a coat.
struct SkinColours {
    Colour colour{};                     ///< The colour in sRGB.
    const CellFilter* filter = nullptr;  ///< Null if there is no coat.
    PaintedCells coat;
};

/// Paints the surface with the objects that hide it from outside. The arguments must outlive this
/// object.
class OutsideSamples : public SamplePainter {
public:
    OutsideSamples(const CellsFromOutside& cells, const SkinColours& skin);

    MapSet maps() const override { return {.heights = true, .normals = true}; }
    void paint(const SampleRow& row) override;
    /// For each sample, takes the normal of the object that is visible there or, if there is none,
    /// of the surface. Returns the sum of these normals.
    Vector3d raised_normal(std::span<const SurfacePlace> samples, const Vector3d& normal) override;

private:
    const CellsFromOutside& cells_;
    Colour skin_;  ///< The skin's colour as reflected fractions of light (see light_of()).
    std::optional<PlacePainter> coat_;
};

}  // namespace cascade
