// Makes a mesh over the parameters. Where a ray hits the mesh, the texture is interpolated
// bilinearly.
#include "run/pictures/surface_picture.h"

#include "picture/srgb.h"
#include "run/pictures/surface_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The number of quadrilaterals along a side of the mesh. With this number the outline is smooth
/// for any grid.
constexpr std::uint32_t facets = 384;

/// Returns the colour of the texture at the centre of a quadrilateral.
const Colour& middle_of(std::uint32_t quadrilateral, const Image& texture) {
    const auto texel = [](std::uint32_t facet, std::int64_t side) {
        return static_cast<std::int64_t>((facet + 0.5) / facets * static_cast<double>(side));
    };
    return texture.at(texel(quadrilateral % facets, texture.width),
                      texel(quadrilateral / facets, texture.height));
}

/// Removes the triangles on transparent parts of the texture. Returns the indices that the
/// remaining triangles had before.
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

/// Interpolates between four texels, of which only the texels that are not transparent count.
/// Returns `otherwise` if all are transparent.
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

/// The cells around a point of the lattice.
struct CellsAt {
    std::uint32_t quadrilateral;
    BetweenCells x, y;
};

Colour colour_of(const Image& texture, const CellsAt& cells, bool has_holes) {
    const auto& [quadrilateral, x, y] = cells;
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
        result[c] =
            mix(mix(texture.at(x.first, y.first)[c], texture.at(x.second, y.first)[c], x.part),
                mix(texture.at(x.first, y.second)[c], texture.at(x.second, y.second)[c], x.part),
                y.part);
    }
    return result;
}

}  // namespace

Image draw_on_surface(const SurfaceFunction& surface, const Image& texture,
                      const GridMaterial& material, const DrawOptions& options, Team& team) {
    const bool periodic_x = material.is_periodic_x, periodic_y = material.is_periodic_y;
    TriangleMesh mesh = surface_lattice(surface, {facets, facets, periodic_x, periodic_y});
    const SurfaceFinish finish(surface, material, mesh);
    const bool has_holes =
        std::any_of(texture.pixels.begin(), texture.pixels.end(), is_transparent);
    const std::vector<std::uint32_t> numbers =
        has_holes ? cut_holes(mesh, texture) : std::vector<std::uint32_t>();
    const auto cells_at = [&](const Hit& hit) {
        const std::uint32_t triangle = has_holes ? numbers[hit.triangle] : hit.triangle;
        const std::uint32_t quadrilateral = triangle / 2;
        const bool upper = triangle % 2 == 0;
        const double across = upper ? hit.u + hit.v : hit.u;
        const double down = upper ? hit.v : hit.u + hit.v;
        return CellsAt{
            quadrilateral,
            BetweenCells((quadrilateral % facets + across) / facets, texture.width, periodic_x),
            BetweenCells((quadrilateral / facets + down) / facets, texture.height, periodic_y)};
    };
    const auto look = [&](const Sight& sight) {
        const CellsAt cells = cells_at(sight.hit);
        Look result;
        result.light = light_of(colour_of(texture, cells, has_holes));
        finish.add_to(result, cells.x, cells.y);
        return result;
    };
    DrawOptions with_opacity = options;
    if (finish.is_translucent()) {
        with_opacity.opacity = [&](const Hit& hit) {
            const CellsAt cells = cells_at(hit);
            return finish.opacity(cells.x, cells.y);
        };
    }
    return draw(RayCaster(mesh), look, with_opacity, team);
}

}  // namespace cascade
