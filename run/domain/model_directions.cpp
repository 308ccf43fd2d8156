// Computes a direction for each triangle by surface/direction_field or surface/key_directions, and
// then smooths the directions.
#include "run/domain/model_directions.h"

#include "lang/program/evaluate.h"
#include "run/domain/model_cells.h"
#include "surface/key_directions.h"

namespace cascade {

namespace {

std::vector<Vector3d> gradient_lines(const Formula& height, const SurfaceMesh& mesh,
                                     const TangentPlanes& planes) {
    const ModelBox box(mesh);
    std::vector<double> heights;
    heights.reserve(mesh.points.size());
    BuiltinValues place{};
    for (const Vector3d& point : mesh.points) {
        const Vector3d at = box.in_script(point);
        place[static_cast<std::size_t>(Builtin::x)] = at.x;
        place[static_cast<std::size_t>(Builtin::y)] = at.y;
        place[static_cast<std::size_t>(Builtin::z)] = at.z;
        heights.push_back(evaluate(height, place));
    }
    return directions(planes, gradients_of_points(mesh, planes, heights), DirectionKind::lines);
}

std::vector<Vector3d> lines_of_keys(std::span<const double> numbers, const SurfaceMesh& mesh,
                                    const TangentPlanes& planes, const std::atomic<bool>& cancel) {
    const ModelBox box(mesh);
    std::vector<KeyDirection> keys;
    for (std::size_t k = 0; k + 5 < numbers.size(); k += 6) {
        keys.push_back({box.in_model({numbers[k], numbers[k + 1], numbers[k + 2]}),
                        {numbers[k + 3], numbers[k + 4], numbers[k + 5]}});
    }
    return key_directions(mesh, planes, keys, DirectionKind::lines, cancel);
}

std::vector<Vector3d> lines_of(const DirectionSettings& settings, const SurfaceMesh& mesh,
                               const TangentPlanes& planes, const std::atomic<bool>& cancel) {
    const auto of_curvature = [&](Principal which) {
        const PrincipalCurvatures curvature = principal_curvatures(mesh);
        return directions(planes, curvature_lines(mesh, planes, curvature, which),
                          DirectionKind::lines);
    };
    switch (settings.kind) {
        case DirectionSettings::Kind::axis: break;
        case DirectionSettings::Kind::gradient:
            return gradient_lines(*settings.height, mesh, planes);
        case DirectionSettings::Kind::curvature_high: return of_curvature(Principal::high);
        case DirectionSettings::Kind::curvature_low: return of_curvature(Principal::low);
        case DirectionSettings::Kind::keys:
            return lines_of_keys(settings.numbers, mesh, planes, cancel);
    }
    const Vector3d axis{settings.numbers[0], settings.numbers[1], settings.numbers[2]};
    return axis_directions(planes, axis, DirectionKind::lines);
}

}  // namespace

std::vector<Vector3d> direction_lines(const DirectionSettings& settings, const SurfaceMesh& mesh,
                                      Team& team, const std::atomic<bool>& cancel) {
    const TangentPlanes planes = planes_of_triangles(mesh);
    std::vector<Vector3d> found = lines_of(settings, mesh, planes, cancel);
    if (!(settings.smoothing > 0) || cancel) return found;
    const double length = settings.smoothing * ModelBox(mesh).longest;
    return smoothed_directions(planes, found, DirectionKind::lines, length, team, cancel);
}

Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel) {
    Anisotropy anisotropy;
    anisotropy.direction = direction_lines(settings, mesh, team, cancel);
    anisotropy.ratio.assign(mesh.triangles.size(), stretch);
    return anisotropy;
}

}  // namespace cascade
