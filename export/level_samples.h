// Baked samples of a simplified surface.
#pragma once

#include "export/painted_cells.h"
#include "export/refine.h"
#include "export/sample_painter.h"
#include "mesh/normals.h"
#include "surface/nearest_place.h"

namespace cascade {

/// The surface that simplified ones represent. The arguments must outlive it. Thread-safe.
class FineSurface {
public:
    /// Cells lie on `mesh`. `displaced` is the same surface raised by their heights, if any.
    FineSurface(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                const RefinedMesh* displaced);

    PlacePainter painter() const { return {filter_, cells_}; }
    const PaintedCells& cells() const { return cells_; }

    /// The nearest point to `point` on the surface, as a position on `mesh`, which has the colours.
    SurfacePlace place_near(Vector3d point) const;
    /// The normal there, bumped by heights with `painter` if the surface is not raised by them.
    Vector3d normal_near(Vector3d point, PlacePainter& painter) const;

private:
    const SurfaceMesh& shape() const { return displaced_ ? displaced_->mesh : mesh_; }
    SurfacePlace shape_near(Vector3d point) const {
        return on_shape_.find(point).value_or(SurfacePlace{});
    }

    const SurfaceMesh& mesh_;
    const CellFilter& filter_;
    const PaintedCells& cells_;
    const RefinedMesh* displaced_;
    NearestPlace on_shape_;
    CornerNormals normals_;  ///< Normals of the shape.
};

/// Paints each sample as the nearest point of the fine surface, with its colour, its material, and
/// its normal, bumped by heights if there are any. Light thus still shows the lost shape (P.
/// Cignoni et al., "A General Method for Preserving Attribute Values on Simplified Meshes", IEEE
/// Visualization 1998). There are no heights.
class LevelSamples : public SamplePainter {
public:
    /// `mesh` is the simplified surface. Both must outlive it.
    LevelSamples(const SurfaceMesh& mesh, const FineSurface& fine)
        : mesh_(mesh), fine_(fine), painter_(fine.painter()) {}

    MapSet maps() const override;
    void paint(const SampleRow& row) override;
    Vector3d raised_normal(std::span<const SurfacePlace> samples, const Vector3d& normal) override;

private:
    const SurfaceMesh& mesh_;
    const FineSurface& fine_;
    PlacePainter painter_;
};

}  // namespace cascade
