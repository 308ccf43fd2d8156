// A surface and the things on it, as seen by rays from outside: for maps with which the surface
// alone resembles both from far away.
#pragma once

#include "export/painted_cells.h"
#include "export/sample_painter.h"
#include "mesh/instances.h"
#include "mesh/normals.h"
#include "render/ray_caster.h"
#include "run/domain/creased_mesh.h"

#include <optional>

namespace cascade {

/// Rays go along the smooth normals of the surface, against their direction, and begin as far away
/// as things reach. Where another part of the surface is nearer, they begin in the middle between
/// both. Thread-safe. Refers to the mesh, which must outlive it.
class CellsFromOutside {
public:
    /// Copies are in the coordinates of the mesh. Throws std::bad_alloc.
    CellsFromOutside(const SurfaceMesh& mesh, Instances copies);
    CellsFromOutside(const CellsFromOutside&) = delete;
    CellsFromOutside& operator=(const CellsFromOutside&) = delete;

    struct Thing {
        Colour light{};     ///< Reflected fractions, 0 … 1 (light_of).
        double height = 0;  ///< Above the surface, in the unit of the mesh.
        Vector3d normal;    ///< Of length 1.
    };
    /// The thing seen above a position. Empty for the surface itself.
    std::optional<Thing> above(const SurfacePlace& place) const;

private:
    const SurfaceMesh& mesh_;
    CornerNormals normals_;
    DrawnMesh drawn_;
    Instances copies_;  ///< In the coordinates of the drawn mesh, like all lengths below.
    float farthest_ = 0;
    std::optional<RayCaster> of_surface_, of_copies_;  ///< Empty without copies.
};

/// The surface below the things: one colour, or a coat.
struct SkinColours {
    Colour colour{};                     ///< sRGB.
    const CellFilter* filter = nullptr;  ///< With a coat. Otherwise null.
    PaintedCells coat;
};

/// Paints the view from outside. Its sources must outlive it.
class OutsideSamples : public SamplePainter {
public:
    OutsideSamples(const CellsFromOutside& cells, const SkinColours& skin);

    MapSet maps() const override { return {.heights = true, .normals = true}; }
    void paint(const SampleRow& row) override;
    /// The sum of the normals at all samples.
    Vector3d raised_normal(std::span<const SurfacePlace> samples, const Vector3d& normal) override;

private:
    const CellsFromOutside& cells_;
    Colour skin_;  ///< Light.
    std::optional<PlacePainter> coat_;
};

}  // namespace cascade
