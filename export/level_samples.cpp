// Finds the nearest point for every sample separately, since colours may jump anywhere.
#include "export/level_samples.h"

#include "picture/srgb.h"

namespace cascade {

FineSurface::FineSurface(const SurfaceMesh& mesh, const CellFilter& filter,
                         const PaintedCells& cells, const RefinedMesh* displaced)
    : mesh_(mesh),
      filter_(filter),
      cells_(cells),
      displaced_(displaced),
      on_shape_(shape()),
      normals_(corner_normals(shape())) {}

SurfacePlace FineSurface::place_near(Vector3d point) const {
    const SurfacePlace place = shape_near(point);
    return displaced_ ? displaced_->origins[place.triangle].at(place.weights) : place;
}

Vector3d FineSurface::normal_near(Vector3d point, PlacePainter& painter) const {
    const SurfacePlace place = shape_near(point);
    const Vector3d normal = normals_.at(shape(), place);
    const bool is_bumped = !displaced_ && !cells_.heights.empty();
    return is_bumped ? raised(normal, painter.rise_at(place)) : normal;
}

MapSet LevelSamples::maps() const {
    MapSet maps = maps_of(fine_.cells().material, false);
    maps.normals = true;
    return maps;
}

void LevelSamples::paint(const SampleRow& row) {
    for (std::size_t k = 0; k < row.lights.size(); ++k) {
        const Vector3d point = position_of(mesh_, row.place(k));
        const PlacePainter::Look look = painter_.at(fine_.place_near(point));
        row.lights[k] = light_of(look.colour);
        row.material[k] = in_light(look.material);
    }
}

/// Computes the normal at the middle sample only.
Vector3d LevelSamples::raised_normal(std::span<const SurfacePlace> samples, const Vector3d&) {
    return fine_.normal_near(position_of(mesh_, samples[samples.size() / 2]), painter_);
}

}  // namespace cascade
