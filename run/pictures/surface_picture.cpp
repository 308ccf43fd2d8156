// A mesh of triangles over the parameters; texels are interpolated bilinearly where rays hit it.
#include "run/pictures/surface_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// Quadrilaterals along a side: enough for a smooth outline, whatever the grid.
constexpr std::uint32_t facets = 384;

/// A mesh of facets × facets quadrilaterals over the square of the parameters. Triangles 2k and 2k
/// + 1 form quadrilateral k; their first corner is its upper left, their second corner is its upper
/// right and its lower right, respectively.
TriangleMesh lattice(const SurfaceFunction& surface) {
    TriangleMesh mesh;
    mesh.positions.reserve((facets + 1) * (facets + 1));
    for (std::uint32_t j = 0; j <= facets; ++j) {
        for (std::uint32_t i = 0; i <= facets; ++i) {
            const Position p =
                surface(static_cast<double>(i) / facets, static_cast<double>(j) / facets);
            mesh.positions.push_back(
                {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
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

/// The texel at the centre of a quadrilateral.
const Colour& middle_of(std::uint32_t quadrilateral, const Image& texture) {
    const auto texel = [](std::uint32_t facet, std::int64_t side) {
        return static_cast<std::int64_t>((facet + 0.5) / facets * static_cast<double>(side));
    };
    return texture.at(texel(quadrilateral % facets, texture.width),
                      texel(quadrilateral / facets, texture.height));
}

/// Removes triangles on transparent parts of the texture. Returns the original indices of those
/// that remain.
std::vector<std::uint32_t> cut_holes(TriangleMesh& mesh, const Image& texture) {
    std::vector<std::uint32_t> numbers;
    std::size_t kept = 0;
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        const std::uint32_t quadrilateral = triangle / 2;
        if (is_transparent(middle_of(quadrilateral, texture))) continue;
        mesh.triangles[kept++] = mesh.triangles[triangle];
        numbers.push_back(triangle);
    }
    mesh.triangles.resize(kept);
    return numbers;
}

/// Interpolates between the visible ones of four texels; `otherwise` if none is visible.
Colour mix_of_seen(const std::array<std::pair<Colour, float>, 4>& texels, const Colour& otherwise) {
    Colour sum{};
    float weights = 0;
    for (const auto& [colour, weight] : texels) {
        if (is_transparent(colour)) continue;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * colour[c];
        weights += weight;
    }
    if (!(weights > 0)) return otherwise;
    for (float& channel : sum) channel /= weights;
    return sum;
}

/// Where joined sides coincide in space their normals are averaged.
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

/// Two neighbours along an axis, and the relative position of a place between them.
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
    const bool has_holes =
        std::any_of(texture.pixels.begin(), texture.pixels.end(), is_transparent);
    const std::vector<std::uint32_t> numbers =
        has_holes ? cut_holes(mesh, texture) : std::vector<std::uint32_t>();
    const auto colour = [&](const Hit& hit) {
        const std::uint32_t triangle = has_holes ? numbers[hit.triangle] : hit.triangle;
        const std::uint32_t quadrilateral = triangle / 2;
        const bool upper = triangle % 2 == 0;
        const double across = upper ? hit.u + hit.v : hit.u;
        const double down = upper ? hit.v : hit.u + hit.v;
        const Between x =
            between((quadrilateral % facets + across) / facets, texture.width, periodic_x);
        const Between y =
            between((quadrilateral / facets + down) / facets, texture.height, periodic_y);
        if (has_holes) {
            return mix_of_seen({{{texture.at(x.first, y.first), (1 - x.part) * (1 - y.part)},
                                 {texture.at(x.second, y.first), x.part * (1 - y.part)},
                                 {texture.at(x.first, y.second), (1 - x.part) * y.part},
                                 {texture.at(x.second, y.second), x.part * y.part}}},
                               middle_of(quadrilateral, texture));
        }
        const auto mix = [](float a, float b, float part) { return a + (b - a) * part; };
        Colour result{};
        for (std::size_t c = 0; c < 3; ++c) {
            result[c] = mix(
                mix(texture.at(x.first, y.first)[c], texture.at(x.second, y.first)[c], x.part),
                mix(texture.at(x.first, y.second)[c], texture.at(x.second, y.second)[c], x.part),
                y.part);
        }
        return result;
    };
    return draw(mesh, colour, options, team);
}

}  // namespace cascade
