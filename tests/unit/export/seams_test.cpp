// Colours of baked maps on both sides of seams, with texture coordinates made by Cascade.
#include "atlas/unwrap.h"
#include "export/bake.h"
#include "mesh/animals.h"
#include "mesh/shapes.h"
#include "unit/surface/even_cells.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::never;

/// Reads a map as renderers do: interpolated linearly between the centres of texels, and repeated.
double seen_at(const Image& map, double u, double v) {
    const double x = u * static_cast<double>(map.width) - 0.5;
    const double y = (1 - v) * static_cast<double>(map.height) - 0.5;
    const double column = std::floor(x), row = std::floor(y);
    const auto texel = [&](int i, int j) {
        const auto wrapped = [](double place, std::int64_t size) {
            return ((static_cast<std::int64_t>(place) % size) + size) % size;
        };
        return static_cast<double>(
            map.at(wrapped(column + i, map.width), wrapped(row + j, map.height))[0]);
    };
    const double right = x - column, down = y - row;
    return (texel(0, 0) * (1 - right) + texel(1, 0) * right) * (1 - down) +
           (texel(0, 1) * (1 - right) + texel(1, 1) * right) * down;
}

struct SeamErrors {
    double seam_length = 0;  ///< The length of all seams, in the unit of the model.
    double jump = 0;         ///< The largest difference between both sides of a seam.
    double mean_jump = 0;    ///< The mean difference between both sides.
    /// The largest difference between the map and the colour of the cells.
    double error = 0;
    double step = 0;  ///< The largest slope of the pattern, per texel.
};

SeamErrors seam_errors(SurfaceMesh mesh, std::int64_t texels) {
    Team team(2);
    mesh.texture = *unwrap(mesh, texels, team, never);
    const SurfaceCells cells = test::cells_of(mesh, 3000);
    std::vector<float> values;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d p = position_of(mesh, place);
        values.push_back(
            static_cast<float>(0.5 + 0.4 * std::sin(7 * p.x) * std::cos(5 * p.y + 4 * p.z)));
    }
    const PaintedCells look = {1,
                               values,
                               [](std::span<const float> at, const SurfacePlace&) -> Colour {
                                   return {at[0], at[0], at[0]};
                               },
                               {}};
    const CellFilter filter(mesh, cells, team);
    BakeOptions options;
    options.width = options.height = texels;
    const Bake baked = *bake(mesh, filter, look, options, team, never);
    PlacePainter painter(filter, look);
    SeamErrors errors;
    const double scale =
        std::sqrt(TextureLayout(mesh, 1, 1).covered_area() / mesh.total_area());  // Textures.
    double count = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists() || other.triangle < t) continue;
            const auto& here = mesh.texture[t];
            const auto& there = mesh.texture[other.triangle];
            const std::uint32_t next = corner_after(k), last = corner_after(other.edge);
            if (here[k] == there[last] && here[next] == there[other.edge]) continue;
            errors.seam_length += length(mesh.corner(t, next) - mesh.corner(t, k));
            double before = 0;
            for (int step = 0; step <= 8; ++step) {
                const double part = step / 8.0;
                const auto seen = [&](const TexturePlace& a, const TexturePlace& b) {
                    const auto between = [&](std::size_t c) {
                        return static_cast<double>(a[c]) * (1 - part) +
                               static_cast<double>(b[c]) * part;
                    };
                    return seen_at(baked.colour, between(0), between(1));
                };
                SurfacePlace place{t, {0, 0, 0}};
                place.weights[k] = 1 - part;
                place.weights[next] = part;
                const auto exact = static_cast<double>(painter.at(place).colour[0]);
                const double one = seen(here[k], here[next]);
                const double two = seen(there[last], there[other.edge]);
                errors.jump = std::max(errors.jump, std::abs(one - two));
                errors.mean_jump += std::abs(one - two);
                errors.error =
                    std::max({errors.error, std::abs(one - exact), std::abs(two - exact)});
                const double edge = length(mesh.corner(t, next) - mesh.corner(t, k));
                const double texels_between = edge / 8 * scale * static_cast<double>(texels);
                if (step > 0) {
                    errors.step = std::max(errors.step, std::abs(exact - before) / texels_between);
                }
                before = exact;
                ++count;
            }
        }
    }
    errors.mean_jump /= count;
    return errors;
}

/// Checks that the differences at seams are within bounds: the centres of the texels on both sides
/// are up to ½ texel away, in a map that is stretched by up to a half.
SeamErrors expect_no_seam(const SurfaceMesh& mesh, std::int64_t texels) {
    const SeamErrors errors = seam_errors(mesh, texels);
    EXPECT_GT(errors.seam_length, 1) << "there are seams to look at";
    EXPECT_LT(errors.error, 1.5 * errors.step);
    EXPECT_LT(errors.jump, 2 * errors.step);
    EXPECT_LT(errors.mean_jump, 0.3 * errors.step);
    return errors;
}

TEST(Seams, DoNotShowOnASphere) {
    for (const std::int64_t texels : {256, 1024}) expect_no_seam(*sphere_mesh(1, 0.1), texels);
}

TEST(Seams, DoNotShowOnAnAnimal) {
    const SeamErrors errors = expect_no_seam(*creature().body.mesh(0.04, never), 2048);
    EXPECT_LT(errors.jump, 2.0 / 255) << "two steps of an 8-bit map";
}

}  // namespace
}  // namespace cascade
