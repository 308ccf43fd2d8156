// Fits the second fundamental form of each triangle by least squares to the normals at its corners,
// rotates it into the tangent planes at the corners, and averages it there.
#include "surface/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

/// Triangles with a smaller ratio of area to squared longest edge are ignored.
constexpr double least_shape = 1e-8;

/// The share of a triangle's area that belongs to each corner (Meyer et al., 2003, section 3.3).
std::array<double, 3> corner_areas(const SurfaceMesh& mesh, std::size_t triangle) {
    const double area = mesh.area(triangle);
    std::array<double, 3> angles{}, squares{}, shares{};
    for (std::size_t k = 0; k < 3; ++k) {
        angles[k] = mesh.angle(triangle, k);
        const Vector3d opposite =
            mesh.corner(triangle, corner_before(k)) - mesh.corner(triangle, corner_after(k));
        squares[k] = dot(opposite, opposite);
    }
    const auto widest =
        static_cast<std::size_t>(std::max_element(angles.begin(), angles.end()) - angles.begin());
    if (angles[widest] >= std::numbers::pi / 2) {
        shares.fill(area / 4);
        shares[widest] = area / 2;
        return shares;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        // Each of the two edges at the corner contributes by the cotangent of its opposite angle.
        const std::size_t a = corner_after(k), b = corner_after(a);
        shares[k] = (squares[a] / std::tan(angles[a]) + squares[b] / std::tan(angles[b])) / 8;
    }
    if (!std::isfinite(shares[0] + shares[1] + shares[2])) shares.fill(area / 3);
    return shares;
}

/// A symmetric bilinear form on a tangent plane.
struct Form {
    double uu = 0, uv = 0, vv = 0;
};

/// Two unit vectors perpendicular to each other and to a normal.
struct Axes {
    Vector3d u, v;
};

Axes axes_around(Vector3d normal) {
    const Vector3d least = std::abs(normal.x) < 0.6   ? Vector3d{1, 0, 0}
                           : std::abs(normal.y) < 0.6 ? Vector3d{0, 1, 0}
                                                      : Vector3d{0, 0, 1};
    const Vector3d u = unit(least - normal * dot(normal, least));
    return {u, cross(normal, u)};
}

/// Rotates the axes of one plane into another plane by the smallest rotation.
Axes turned(const Axes& axes, Vector3d from, Vector3d to) {
    const double cosine = dot(from, to);
    if (cosine <= -1 + 1e-12) return {-axes.u, -axes.v};
    // Rotates by two reflections. The first does not change v. The second subtracts twice the
    // component of v along the mean of the normals.
    const Vector3d sum = from + to;
    const auto turn = [&](Vector3d v) { return v - sum * (dot(v, to) / (1 + cosine)); };
    return {turn(axes.u), turn(axes.v)};
}

/// The second fundamental form of one triangle, fitted by least squares. For each edge e of the
/// triangle, form · e should be the change of the normal along e. Each edge gives two equations for
/// uu, uv and vv.
struct TriangleForm {
    bool is_known = false;
    Axes axes;
    Vector3d normal;
    Form form;
};

TriangleForm form_of(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                     std::size_t triangle) {
    TriangleForm result;
    std::array<Vector3d, 3> edges;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        edges[k] = mesh.corner(triangle, corner_after(k)) - mesh.corner(triangle, k);
        size = std::max(size, length(edges[k]));
    }
    if (!(size > 0)) return result;
    for (Vector3d& edge : edges) edge = edge * (1 / size);
    const Vector3d twice_area = cross(edges[0], edges[1]);
    if (!(length(twice_area) > least_shape)) return result;
    result.normal = unit(twice_area);
    result.axes = axes_around(result.normal);
    const auto& [u, v] = result.axes;
    // The normal equations: [a b 0; b a+c b; 0 b c] (uu, uv, vv) = (r, s, t).
    double a = 0, b = 0, c = 0, r = 0, s = 0, t = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d change = normals[mesh.triangles[triangle][corner_after(k)]] -
                                normals[mesh.triangles[triangle][k]];
        const double x = dot(edges[k], u), y = dot(edges[k], v);
        const double dx = dot(change, u), dy = dot(change, v);
        a += x * x;
        b += x * y;
        c += y * y;
        r += x * dx;
        s += x * dy + y * dx;
        t += y * dy;
    }
    // Solves for uv first. a c − b² measures the spread of the edges and is positive.
    const double determinant = (a * c - b * b) * (a + c);
    const double uv = (a * c * s - b * c * r - a * b * t) / determinant;
    result.form = {(r - b * uv) / a / size, uv / size, (t - b * uv) / c / size};
    result.is_known = std::isfinite(result.form.uu) && std::isfinite(result.form.uv) &&
                      std::isfinite(result.form.vv);
    return result;
}

/// The form expressed in other axes of the same plane.
Form on_axes(const TriangleForm& triangle, const Axes& axes) {
    const auto apply = [&](Vector3d a, Vector3d b) {
        const double ax = dot(a, triangle.axes.u), ay = dot(a, triangle.axes.v);
        const double bx = dot(b, triangle.axes.u), by = dot(b, triangle.axes.v);
        const Form& f = triangle.form;
        return f.uu * ax * bx + f.uv * (ax * by + ay * bx) + f.vv * ay * by;
    };
    return {apply(axes.u, axes.u), apply(axes.u, axes.v), apply(axes.v, axes.v)};
}

/// Calls visit(p, q) once for each edge of the mesh.
template <typename Visit>
void for_each_edge(const SurfaceMesh& mesh, const Visit& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (other.exists() && other.triangle < t) continue;
            visit(mesh.triangles[t][k], mesh.triangles[t][corner_after(k)]);
        }
    }
}

}  // namespace

std::vector<Vector3d> sphere_normals(const SurfaceMesh& mesh) {
    std::vector<Vector3d> sums(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d here = mesh.corner(t, k);
            const Vector3d a = mesh.corner(t, corner_after(k)) - here;
            const Vector3d b = mesh.corner(t, corner_before(k)) - here;
            const double size = length(a) * length(b);
            if (!(size > 0)) continue;
            // a × b / (|a|² |b|²)
            const Vector3d share = cross(unit(a), unit(b)) * (1 / size);
            Vector3d& sum = sums[mesh.triangles[t][k]];
            if (std::isfinite(dot(share, share))) sum = sum + share;
        }
    }
    for (std::size_t p = 0; p < sums.size(); ++p) {
        const double size = length(sums[p]);
        sums[p] = size > 0 && std::isfinite(size) ? sums[p] * (1 / size) : Vector3d{};
    }
    // If the normals around a point cancel out, the point gets the normal of one of its triangles.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t point : mesh.triangles[t]) {
            if (length(sums[point]) > 0.5) continue;
            const Vector3d normal = unit(mesh.double_area_normal(t));
            sums[point] = length(normal) > 0.5 ? normal : Vector3d{0, 0, 1};
        }
    }
    return sums;
}

PrincipalCurvatures principal_curvatures(const SurfaceMesh& mesh) {
    const std::vector<Vector3d> normals = sphere_normals(mesh);
    const std::size_t count = mesh.points.size();
    std::vector<Axes> axes;
    axes.reserve(count);
    for (const Vector3d& normal : normals) axes.push_back(axes_around(normal));
    std::vector<Form> sums(count);
    std::vector<double> weights(count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const TriangleForm triangle = form_of(mesh, normals, t);
        if (!triangle.is_known) continue;
        const std::array<double, 3> shares = corner_areas(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = mesh.triangles[t][k];
            const Form form = on_axes(triangle, turned(axes[p], normals[p], triangle.normal));
            sums[p].uu += form.uu * shares[k];
            sums[p].uv += form.uv * shares[k];
            sums[p].vv += form.vv * shares[k];
            weights[p] += shares[k];
        }
    }
    PrincipalCurvatures result;
    for (std::size_t p = 0; p < count; ++p) {
        const double scale = weights[p] > 0 ? 1 / weights[p] : 0;
        const double mean = (sums[p].uu + sums[p].vv) / 2 * scale;
        const double half = (sums[p].uu - sums[p].vv) / 2 * scale, mixed = sums[p].uv * scale;
        const double apart = std::hypot(half, mixed);
        const double angle = std::atan2(mixed, half) / 2;
        const Vector3d high = axes[p].u * std::cos(angle) + axes[p].v * std::sin(angle);
        result.high.push_back(mean + apart);
        result.low.push_back(mean - apart);
        result.high_direction.push_back(high);
        result.low_direction.push_back(cross(normals[p], high));
    }
    return result;
}

std::vector<double> turk_radii(const SurfaceMesh& mesh, int rounds) {
    const std::vector<Vector3d> normals = sphere_normals(mesh);
    const MeshFacts facts = facts_of(mesh);
    std::vector<double> radii(mesh.points.size(), length(facts.high - facts.low));
    for_each_edge(mesh, [&](std::uint32_t p, std::uint32_t q) {
        const Vector3d edge = mesh.points[q] - mesh.points[p];
        const double size = length(edge);
        for (const std::uint32_t end : {p, q}) {
            // |tan θ| |P − Q| / 2, where θ is the angle between the edge and the normal.
            const double cosine = std::abs(dot(normals[end], unit(edge)));
            const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
            if (sine * size / 2 < radii[end] * cosine) radii[end] = sine * size / 2 / cosine;
        }
    });
    std::vector<double> sums;
    std::vector<std::uint32_t> counts;
    for (int round = 0; round < rounds; ++round) {
        sums = radii;
        counts.assign(radii.size(), 1);
        for_each_edge(mesh, [&](std::uint32_t p, std::uint32_t q) {
            sums[p] += radii[q];
            sums[q] += radii[p];
            ++counts[p];
            ++counts[q];
        });
        for (std::size_t p = 0; p < radii.size(); ++p) radii[p] = sums[p] / counts[p];
    }
    return radii;
}

}  // namespace cascade
