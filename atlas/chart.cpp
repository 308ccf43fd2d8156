// Finds the corners that share a position by union-find. Stretches are singular values, computed in
// closed form.
#include "atlas/chart.h"

#include "mesh/disjoint_sets.h"

#include <algorithm>
#include <cmath>

namespace cascade {

FlatTriangle shape_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    constexpr double least = 1e-4;
    const Vector3d a = mesh.corner(triangle, 0);
    const Vector3d ab = mesh.corner(triangle, 1) - a, ac = mesh.corner(triangle, 2) - a;
    const double longest = std::max(
        {length(ab), length(ac), length(ac - ab), 1e3 * std::numeric_limits<double>::min()});
    const double base = std::max(length(ab), least * longest);
    return {Vector2d{0, 0}, Vector2d{base, 0},
            Vector2d{dot(ab, ac) / base, std::max(length(cross(ab, ac)) / base, least * longest)}};
}

Chart chart_of(const SurfaceMesh& mesh, const Seams& seams, std::vector<std::uint32_t> triangles,
               std::span<std::uint32_t> numbers) {
    for (std::uint32_t k = 0; k < triangles.size(); ++k) numbers[triangles[k]] = k;
    DisjointSets same(3 * triangles.size());
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
        const std::uint32_t t = triangles[n];
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (seams[t][k]) continue;
            const TriangleEdge other = mesh.across[t][k];
            const std::uint32_t o = numbers[other.triangle];
            same.join(3 * n + k, 3 * o + corner_after(other.edge));
            same.join(3 * n + corner_after(k), 3 * o + other.edge);
        }
    }
    Chart chart;
    chart.corners.resize(triangles.size());
    std::vector<std::uint32_t> place_of(3 * triangles.size());
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < place_of.size(); ++c) {
        // A set has the number of its first corner, which is visited before its other corners.
        const std::uint32_t first = same.find(c);
        place_of[c] = first == c ? count++ : place_of[first];
        chart.corners[c / 3][c % 3] = place_of[c];
    }
    chart.places.resize(count);
    chart.turns.assign(triangles.size(), {1, 0});
    chart.triangles = std::move(triangles);
    return chart;
}

std::array<double, 2> stretches(const FlatTriangle& shape, const FlatTriangle& image) {
    const Vector2d from_b = shape[1] - shape[0], from_c = shape[2] - shape[0];
    const Vector2d to_b = image[1] - image[0], to_c = image[2] - image[0];
    const double area = cross(from_b, from_c);
    const auto column = [&](double b, double c) {
        return Vector2d{(to_b.x * b + to_c.x * c) / area, (to_b.y * b + to_c.y * c) / area};
    };
    const Vector2d x = column(from_c.y, -from_b.y), y = column(-from_c.x, from_b.x);
    const double turning = std::hypot(x.x + y.y, x.y - y.x) / 2;
    const double mirroring = std::hypot(x.x - y.y, x.y + y.x) / 2;
    return {turning + mirroring, turning - mirroring};
}

}  // namespace cascade
