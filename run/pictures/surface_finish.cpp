// Measures the slopes of heights at the centres of cells, by central differences along both
// parameters.
#include "run/pictures/surface_finish.h"

#include "picture/srgb.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

Vector3d in_space(const Position& p) { return {p[0], p[1], p[2]}; }

/// Returns the gradient along the surface of a number, at the parameters (s, t). `along_s` and
/// `along_t` are the derivatives of the number with respect to the parameters. The result is 0
/// where the surface has no area.
Vector3d gradient(const SurfaceFunction& surface, double s, double t, double along_s,
                  double along_t) {
    constexpr double step = 1e-4;
    const auto difference = [&](double ds, double dt) {
        return (in_space(surface(s + ds, t + dt)) - in_space(surface(s - ds, t - dt))) *
               (1 / (2 * step));
    };
    const Vector3d a = difference(step, 0), b = difference(0, step), normal = cross(a, b);
    const double area = dot(normal, normal);
    if (!(area > 0)) return {};
    return (cross(b, normal) * along_s + cross(normal, a) * along_t) * (1 / area);
}

/// Whether most normals point towards the middle of the mesh.
bool looks_inwards(const TriangleMesh& mesh) {
    const Vector3 middle = bounds(mesh).centre();
    double sum = 0;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        sum += static_cast<double>(dot(mesh.normals[k], mesh.positions[k] - middle));
    }
    return sum < 0;
}

double area_of(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += static_cast<double>(length(cross(mesh.positions[b] - mesh.positions[a],
                                                mesh.positions[c] - mesh.positions[a]))) /
               2;
    }
    return sum;
}

}  // namespace

SurfaceFinish::SurfaceFinish(const SurfaceFunction& surface, const GridMaterial& grid,
                             const TriangleMesh& mesh)
    : material_(grid.material), columns_(grid.columns), is_flipped_(looks_inwards(mesh)) {
    is_cut_ = is_cut(material_.parts[MaterialPart::opacity]);
    if (material_.heights.empty()) return;
    const auto cells = static_cast<double>(grid.columns * grid.rows) /
                       static_cast<double>(grid.detail * grid.detail);
    measure_slopes(surface, grid, grid.unit.value_or(std::sqrt(area_of(mesh) / cells)));
}

void SurfaceFinish::measure_slopes(const SurfaceFunction& surface, const GridMaterial& grid,
                                   double unit) {
    const auto neighbour = [](std::int64_t cell, int by, std::int64_t side, bool is_periodic) {
        const std::int64_t next = cell + by;
        return is_periodic ? (next + side) % side : std::clamp<std::int64_t>(next, 0, side - 1);
    };
    const auto rise = [&](std::int64_t from, std::int64_t to) {
        const auto height = [&](std::int64_t cell) {
            return static_cast<double>(material_.heights[static_cast<std::size_t>(cell)]);
        };
        return unit * (height(to) - height(from)) / 2;
    };
    slopes_.reserve(static_cast<std::size_t>(grid.columns * grid.rows));
    for (std::int64_t j = 0; j < grid.rows; ++j) {
        const std::int64_t up = neighbour(j, -1, grid.rows, grid.is_periodic_y);
        const std::int64_t down = neighbour(j, 1, grid.rows, grid.is_periodic_y);
        for (std::int64_t i = 0; i < grid.columns; ++i) {
            const std::int64_t left = neighbour(i, -1, grid.columns, grid.is_periodic_x);
            const std::int64_t right = neighbour(i, 1, grid.columns, grid.is_periodic_x);
            const auto columns = static_cast<double>(grid.columns);
            const auto rows = static_cast<double>(grid.rows);
            const Vector3d slope =
                gradient(surface, (static_cast<double>(i) + 0.5) / columns,
                         (static_cast<double>(j) + 0.5) / rows,
                         columns * rise(j * grid.columns + left, j * grid.columns + right),
                         rows * rise(up * grid.columns + i, down * grid.columns + i));
            slopes_.push_back(std::isfinite(dot(slope, slope)) ? single(slope) : Vector3{});
        }
    }
}

float SurfaceFinish::opacity(const BetweenCells& x, const BetweenCells& y) const {
    const float part = between(material_.parts[MaterialPart::opacity], x, y);
    if (is_cut_) return part < 0.5F ? 0.0F : 1.0F;
    return part;
}

void SurfaceFinish::add_to(Look& look, const BetweenCells& x, const BetweenCells& y) const {
    const auto& parts = material_.parts;
    const auto number = [&](MaterialPart part, float usual) {
        return parts[part].empty() ? usual : between(parts[part], x, y);
    };
    if (!parts[MaterialPart::red].empty()) {
        look.glow = light_of(Colour{number(MaterialPart::red, 0), number(MaterialPart::green, 0),
                                    number(MaterialPart::blue, 0)});
    }
    if (!parts[MaterialPart::roughness].empty() || !parts[MaterialPart::metalness].empty()) {
        look.gloss =
            gloss_of(number(MaterialPart::roughness, 0.6F), number(MaterialPart::metalness, 0));
    }
    if (slopes_.empty()) return;
    const Vector3 slope = between(slopes_, x, y);
    look.tilt = is_flipped_ ? slope : -slope;
}

}  // namespace cascade
