// What is known at the points of a mesh, at places between them.
#pragma once

#include "mesh/flat.h"

#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Linear between the corners of the place's triangle. One value per point of the mesh; Number is a
/// float or a double.
template <typename Number>
double value_at(const SurfaceMesh& mesh, const std::vector<Number>& point_values,
                const SurfacePlace& place) {
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        value +=
            static_cast<double>(point_values[mesh.triangles[place.triangle][k]]) * place.weights[k];
    }
    return value;
}

/// The same at many places, such as those of cells.
template <typename Number>
std::vector<double> values_at(const SurfaceMesh& mesh, const std::vector<Number>& point_values,
                              std::span<const SurfacePlace> places) {
    std::vector<double> values;
    values.reserve(places.size());
    for (const SurfacePlace& place : places) values.push_back(value_at(mesh, point_values, place));
    return values;
}

/// Where a place of the surface lies in its texture, (0, 0) the lower left and (1, 1) the upper
/// right of the image; beyond these it repeats. Linear between the corners of the triangle, each of
/// which has places of its own, so seams are where the model has them. Nothing if the model has
/// none.
inline std::optional<std::array<double, 2>> texture_place_at(const SurfaceMesh& mesh,
                                                             const SurfacePlace& place) {
    if (mesh.texture.empty()) return std::nullopt;
    std::array<double, 2> at = {0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const TexturePlace& corner = mesh.texture[place.triangle][k];
        at[0] += static_cast<double>(corner[0]) * place.weights[k];
        at[1] += static_cast<double>(corner[1]) * place.weights[k];
    }
    return at;
}

}  // namespace cascade
