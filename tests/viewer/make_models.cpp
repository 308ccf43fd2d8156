// Writes GLB files into the current folder. tests/viewer_test.sh opens them, and
// tests/viewer/view.mjs contains what they must look like.
#include "export/bake.h"
#include "export/instanced_model.h"
#include "export/model_writer.h"
#include "export/plane_maps.h"
#include "export/point_values.h"
#include "unit/export/example_surfaces.h"
#include "unit/mesh/example_shapes.h"
#include "unit/surface/even_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cascade {
namespace {

/// Red where the first channel is 0, blue where it is 1.
Colour red_to_blue(std::span<const float> values, const SurfacePlace&) {
    const float blue = std::clamp(values[0], 0.0F, 1.0F);
    return {0.8F - 0.7F * blue, 0.2F, 0.1F + 0.8F * blue};
}

Colour white(std::span<const float>, const SurfacePlace&) { return {1, 1, 1}; }

bool report(const Result<void>& written) {
    if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
    return written.has_value();
}

bool write_maps(const char* name, const SurfaceMesh& mesh, const CellFilter& filter,
                const PaintedCells& look, Team& team) {
    BakeOptions options;
    options.width = 256;
    options.height = 128;
    const Result<Bake> maps = bake(mesh, filter, look, options, team, test::never);
    if (!maps) std::fprintf(stderr, "%s\n", maps.error().message.c_str());
    return maps && report(cascade::write_maps(name, mesh, *maps, {}));
}

/// Writes a sphere that is red where x < 0 and blue elsewhere, with colours of points and with a
/// texture.
bool write_spheres(Team& team) {
    const SurfaceMesh mesh = test::sphere_with_texture(48);
    const SurfaceCells cells = test::cells_of(mesh, 4000);
    const CellFilter filter(mesh, cells, team);
    std::vector<float> values, heights;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d p = position_of(mesh, place);
        values.push_back(p.x < 0 ? 0.0F : 1.0F);
        heights.push_back(static_cast<float>(0.02 * std::sin(20 * p.z)));
    }
    const PaintedCells look{1, values, red_to_blue, heights};
    const std::vector<Colour> colours = colours_at(places_of_points(mesh), filter, look, team);
    return report(write_model("points.glb", mesh, {colours, {}})) &&
           write_maps("maps.glb", mesh, filter, look, team);
}

/// Writes a white square with a hill in its middle, and the same square with mirrored texture
/// coordinates.
bool write_hills(Team& team) {
    SurfaceMesh mesh = test::flat_square(8);
    const SurfaceCells cells = test::cells_of(mesh, 4000);
    const CellFilter filter(mesh, cells, team);
    std::vector<float> heights;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d p = position_of(mesh, place) - Vector3d{0.5, 0.5, 0};
        heights.push_back(static_cast<float>(0.1 * std::exp(-dot(p, p) / 0.02)));
    }
    const PaintedCells look{1, heights, white, heights};
    if (!write_maps("hill.glb", mesh, filter, look, team)) return false;
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place[0] = 1 - place[0];
    }
    return write_maps("mirrored_hill.glb", mesh, filter, look, team);
}

/// Writes a square of four bands, from the top: a hole, a band that sees half of the sky, a plain
/// band, and a metal band. The left half of the square is black and glows, the right half is red.
bool write_tile(Team& team) {
    const FlatCells cells{64, 64, 1.0 / 64, {false, false}};
    std::vector<float> colours;
    OfParts<std::vector<float>> parts;
    for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 64; ++i) {
            const bool glows = i < 32;
            const Colour colour = glows ? Colour{} : Colour{0.8F, 0.2F, 0.1F};
            colours.insert(colours.end(), colour.begin(), colour.end());
            parts[MaterialPart::opacity].push_back(j < 16 ? 0.0F : 1.0F);
            parts[MaterialPart::occlusion].push_back(j < 32 ? 0.5F : 1.0F);
            parts[MaterialPart::roughness].push_back(0.7F);
            parts[MaterialPart::metalness].push_back(j < 48 ? 0.0F : 1.0F);
            parts[MaterialPart::red].push_back(glows ? 0.2F : 0.0F);
            parts[MaterialPart::green].push_back(glows ? 0.6F : 0.0F);
            parts[MaterialPart::blue].push_back(glows ? 0.4F : 0.0F);
        }
    }
    const auto as_it_is = [](std::span<const float> rgb, const SurfacePlace&) {
        return Colour{rgb[0], rgb[1], rgb[2]};
    };
    PaintedCells look{3, colours, as_it_is, {}};
    for (std::size_t k = 0; k < material_parts; ++k) look.material[k] = parts[k];
    return report(cascade::write_maps("tile.glb", plane_mesh(cells),
                                      bake_plane(cells, look, texture_size(cells, 256), team), {}));
}

/// Writes copies of a ball in front of a square, as instances and merged: at the bottom a row of 64
/// balls whose colours go from red to blue, and at the top a long green ball that extends from left
/// to right.
bool write_copies() {
    const SurfaceMesh square = test::flat_square(2);
    const std::vector<Colour> colours(square.points.size(), Colour{0.2F, 0.2F, 0.2F});
    Instances copies;
    copies.meshes.push_back(test::ball({1, 0.01}));
    constexpr int count = 64;
    for (int k = 0; k < count; ++k) {
        const double part = (k + 0.5) / count;
        Placement copy;
        copy.place = {part, 0.25, 0.2};
        copy.scale = {0.05, 0.1, 0.05};
        const auto blue = static_cast<float>(part);
        copy.colour = {0.8F - 0.7F * blue, 0.2F, 0.1F + 0.8F * blue};
        copies.placements.push_back(copy);
    }
    Placement lying;
    lying.place = {0.5, 0.75, 0.2};
    lying.turn = quaternion_of({0, -1, 0}, {1, 0, 0}, {0, 0, 1});
    lying.scale = {0.1, 0.4, 0.1};
    lying.colour = {0.1F, 0.8F, 0.2F};
    copies.placements.push_back(lying);
    const InstancedModel model{&square, colours, copies};
    return report(write_instanced("copies.glb", model, false)) &&
           report(write_instanced("merged_copies.glb", model, true));
}

}  // namespace
}  // namespace cascade

int main() {
    cascade::Team team(2);
    return cascade::write_spheres(team) && cascade::write_hills(team) &&
                   cascade::write_tile(team) && cascade::write_copies()
               ? 0
               : 1;
}
