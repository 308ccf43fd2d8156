// Properties of every mesh that is read from a model, for tests and fuzzers.
#pragma once

#include "mesh/make_mesh.h"

#include <cmath>

namespace cascade::test {

/// The first fault of a mesh, or nullptr.
inline const char* fault_of_soup(const PolygonSoup& soup) {
    for (const std::uint32_t corner : soup.corners) {
        if (corner >= soup.points.size()) return "a corner is no point";
    }
    if ((soup.ends.empty() ? 0 : soup.ends.back()) != soup.corners.size()) {
        return "polygons have not all corners";
    }
    if (!soup.texture.empty() && soup.texture.size() != soup.corners.size()) {
        return "some corners have a place in the texture and some have not";
    }
    for (const PointAttribute& attribute : soup.attributes) {
        if (attribute.values.size() != soup.points.size())
            return "an attribute is not of all points";
    }
    return nullptr;
}

inline const char* fault_of_mesh(const SurfaceMesh& mesh) {
    if (mesh.across.size() != mesh.triangles.size()) return "a triangle has no neighbours";
    if (!mesh.texture.empty() && mesh.texture.size() != mesh.triangles.size()) {
        return "some triangles have a place in the texture and some have not";
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (mesh.triangles[t][k] >= mesh.points.size()) return "a corner is no point";
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            if (mesh.across[other.triangle][other.edge] != TriangleEdge{t, k}) {
                return "a link does not lead back";
            }
            if (mesh.triangles[other.triangle][other.edge] != mesh.triangles[t][(k + 1) % 3]) {
                return "neighbours turn against each other";
            }
        }
    }
    const double area = facts_of(mesh).area;
    return std::isfinite(area) && area > 0 ? nullptr : "the surface has no area";
}

}  // namespace cascade::test
