#include "run/surface_picture.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Quadrilaterals along a side: enough for a smooth outline, whatever the grid.
constexpr std::uint32_t facets = 384;

/// A lattice of facets × facets quadrilaterals in the square of the parameters. Triangles 2k and
/// 2k + 1 are quadrilateral k, their first corner its upper left, the second the upper right of
/// the one and the lower right of the other.
TriangleMesh lattice(const SurfaceFunction& surface) {
    TriangleMesh mesh;
    mesh.positions.reserve((facets + 1) * (facets + 1));
    for (std::uint32_t j = 0; j <= facets; ++j) {
        for (std::uint32_t i = 0; i <= facets; ++i) {
            const Position p = surface(static_cast<double>(i) / facets,
                                       static_cast<double>(j) / facets);
            mesh.positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]),
                                      static_cast<float>(p[2])});
        }
    }
    for (std::uint32_t j = 0; j < facets; ++j) {
        for (std::uint32_t i = 0; i < facets; ++i) {
            const std::uint32_t corner = j * (facets + 1) + i;
            mesh.triangles.push_back({corner, corner + 1, corner + facets + 2});
            mesh.triangles.push_back({corner, corner + facets + 2, corner + facets + 1});
        }
    }
    smooth_normals(mesh);
    return mesh;
}

/// Where two joined sides meet in space their normals are one.
void join_normals(TriangleMesh& mesh, bool periodic_x, bool periodic_y) {
    const Box box = bounds(mesh);
    const float near = 1e-4F * length(box.high - box.low);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (length(mesh.positions[a] - mesh.positions[b]) > near) return;
        const Vector3 sum = unit(mesh.normals[a] + mesh.normals[b]);
        mesh.normals[a] = mesh.normals[b] = sum;
    };
    for (std::uint32_t k = 0; k <= facets; ++k) {
        if (periodic_x) join(k * (facets + 1), k * (facets + 1) + facets);
        if (periodic_y) join(k, facets * (facets + 1) + k);
    }
}

/// Two neighbours along an axis and how far the place lies from the first to the second.
struct Between {
    std::int64_t first = 0, second = 0;
    float part = 0;
};

Between between(double s, std::int64_t side, bool periodic) {
    const double place = s * static_cast<double>(side) - 0.5;
    const double below = std::floor(place);
    const auto cell = static_cast<std::int64_t>(below);
    const auto inside = [&](std::int64_t i) {
        return periodic ? (i + side) % side : std::clamp<std::int64_t>(i, 0, side - 1);
    };
    return {inside(cell), inside(cell + 1), static_cast<float>(place - below)};
}

}  // namespace

Image draw_on_surface(const SurfaceFunction& surface, const Image& texture, bool periodic_x,
                      bool periodic_y, const DrawOptions& options, Team& team) {
    TriangleMesh mesh = lattice(surface);
    join_normals(mesh, periodic_x, periodic_y);
    const auto colour = [&](const Hit& hit) {
        const std::uint32_t quadrilateral = hit.triangle / 2;
        const bool upper = hit.triangle % 2 == 0;
        const double across = upper ? hit.u + hit.v : hit.u;
        const double down = upper ? hit.v : hit.u + hit.v;
        const Between x =
            between((quadrilateral % facets + across) / facets, texture.width, periodic_x);
        const Between y =
            between((quadrilateral / facets + down) / facets, texture.height, periodic_y);
        const auto mix = [](float a, float b, float part) { return a + (b - a) * part; };
        Colour result{};
        for (std::size_t c = 0; c < 3; ++c) {
            result[c] = mix(mix(texture.at(x.first, y.first)[c], texture.at(x.second, y.first)[c],
                                x.part),
                            mix(texture.at(x.first, y.second)[c],
                                texture.at(x.second, y.second)[c], x.part),
                            y.part);
        }
        return result;
    };
    return draw(mesh, colour, options, team);
}

}  // namespace cascade
