// Sorts corners by normal, side and texture coordinates. Corners that agree in all of these become
// one vertex. The tangent of a vertex is the mean of its triangles' tangents, weighted by angle.
#include "export/render_vertices.h"

#include "mesh/flat.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cascade {

namespace {

TexturePlace finite(TexturePlace place) {
    for (float& number : place) {
        if (!std::isfinite(number)) number = 0;
        number += 0.0F;  // −0 becomes 0.
    }
    return place;
}

/// The orientation of the texture in a triangle.
struct TriangleTangent {
    /// Direction in which the first coordinate grows; 0 if the triangle has no area in the texture.
    Vector3d direction;
    int side = 1;
};

TriangleTangent tangent_of(const SurfaceMesh& mesh, std::size_t t) {
    const auto step = [&](std::size_t k) {
        const TexturePlace a = finite(mesh.texture[t][0]), b = finite(mesh.texture[t][k]);
        return Vector2d{static_cast<double>(b[0]) - static_cast<double>(a[0]),
                        static_cast<double>(b[1]) - static_cast<double>(a[1])};
    };
    const Vector2d first = step(1), second = step(2);
    const double area = cross(first, second);
    if (area == 0 || !std::isfinite(area)) return {};
    const Vector3d a = mesh.corner(t, 0);
    const Vector3d along = (mesh.corner(t, 1) - a) * second.y - (mesh.corner(t, 2) - a) * first.y;
    return {unit(along * (area > 0 ? 1.0 : -1.0)), area > 0 ? 1 : -1};
}

/// The component of a vector perpendicular to a normal, scaled to length 1; 0 if the component
/// vanishes.
Vector3d across(Vector3d vector, Vector3d normal) {
    const Vector3d left = vector - normal * dot(vector, normal);
    return length(left) > 1e-6 ? unit(left) : Vector3d{};
}

/// Any unit vector perpendicular to a normal.
Vector3d any_across(Vector3d normal) {
    return across(std::abs(normal.x) < 0.9 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}, normal);
}

}  // namespace

RenderVertices render_vertices(const SurfaceMesh& mesh, const CornerNormals& normals) {
    if (mesh.texture.empty()) return {normals.points, normals.normals, {}, {}, normals.numbers};
    struct Corner {
        std::uint32_t normal;
        int side;
        TexturePlace place;
        std::uint32_t number;
        auto vertex() const { return std::tie(normal, side, place); }
    };
    std::vector<Corner> corners;
    std::vector<TriangleTangent> tangents;
    corners.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        tangents.push_back(tangent_of(mesh, t));
        for (std::uint32_t k = 0; k < 3; ++k) {
            corners.push_back(
                {normals.numbers[t][k], tangents[t].side, finite(mesh.texture[t][k]), 3 * t + k});
        }
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
        return a.vertex() != b.vertex() ? a.vertex() < b.vertex() : a.number < b.number;
    });
    RenderVertices result;
    result.triangles.resize(mesh.triangles.size());
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Corner& corner = corners[c];
        const Vector3d normal = normals.normals[corner.normal];
        if (c == 0 || corners[c - 1].vertex() != corner.vertex()) {
            result.points.push_back(normals.points[corner.normal]);
            result.normals.push_back(normal);
            result.texture.push_back(corner.place);
            result.tangents.push_back({{}, corner.side});
        }
        const std::uint32_t t = corner.number / 3, k = corner.number % 3;
        result.triangles[t][k] = static_cast<std::uint32_t>(result.points.size() - 1);
        Vector3d& sum = result.tangents.back().direction;
        sum = sum + across(tangents[t].direction, normal) * mesh.angle(t, k);
    }
    for (std::size_t v = 0; v < result.points.size(); ++v) {
        Vector3d& direction = result.tangents[v].direction;
        direction = across(direction, result.normals[v]);
        if (length(direction) == 0) direction = any_across(result.normals[v]);
    }
    return result;
}

}  // namespace cascade
