// Samples of a simplified surface, for baking.
#pragma once

#include "export/painted_cells.h"
#include "export/refine.h"
#include "export/sample_painter.h"
#include "mesh/normals.h"
#include "surface/nearest_place.h"

namespace cascade {

/// A fine surface with a pattern that is painted on simplified versions of the surface. The
/// arguments must outlive the object. Thread-safe.
class FineSurface {
public:
    /// The cells are on `mesh`. `displaced` is null, or the same surface raised by the heights of
    /// the cells.
    FineSurface(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                const RefinedMesh* displaced);

    PlacePainter painter() const { return {filter_, cells_}; }
    const PaintedCells& cells() const { return cells_; }

    /// The position on `mesh` that corresponds to the point of the surface (of the raised surface,
    /// if there is one) nearest to `point`.
    SurfacePlace place_near(Vector3d point) const;
    /// The normal at place_near(). If the surface is not raised by heights, `painter` adds the
    /// heights as bumps.
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
    /// Normals of the raised surface, if there is one, otherwise of `mesh`.
    CornerNormals normals_;
};

/// Paints samples of a simplified surface. Each sample gets the colour, the material and the
/// normal, with bumps of heights, of the nearest point of the fine surface. So light still shows
/// the details that simplification has removed (P. Cignoni et al., "A General Method for Preserving
/// Attribute Values on Simplified Meshes", IEEE Visualization 1998). Gives no heights.
class LevelSamples : public SamplePainter {
public:
    /// `mesh` is the simplified surface. Both arguments must outlive the painter.
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
