// Interpolates values given at the points of a mesh.
#pragma once

#include "mesh/flat.h"

#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Interpolates one value per point of the mesh linearly in the position's triangle.
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

/// Does the same as value_at() for many positions, such as the positions of cells.
template <typename Number>
std::vector<double> values_at(const SurfaceMesh& mesh, const std::vector<Number>& point_values,
                              std::span<const SurfacePlace> places) {
    std::vector<double> values;
    values.reserve(places.size());
    for (const SurfacePlace& place : places) values.push_back(value_at(mesh, point_values, place));
    return values;
}

/// The texture coordinates at a position, (0, 0) at the lower left and (1, 1) at the upper right of
/// the image. Beyond these limits the image repeats. Coordinates are linear in each triangle, whose
/// corners have their own coordinates, so that seams are possible. nullopt if the model has no
/// texture coordinates.
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
