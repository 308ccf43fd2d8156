// Below the cells there is a model, a body or a floor. In a box there is no surface.
#include "run/pictures/tissue_picture.h"

#include "picture/srgb.h"
#include "run/domain/creased_mesh.h"
#include "run/pictures/model_picture.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cascade {

void lay_flat(Instances& copies) {
    const auto swapped = [](Vector3d v) { return Vector3d{v.x, v.z, v.y}; };
    for (Placement& each : copies.placements) {
        each.place = swapped(each.place);
        each.turn = quaternion_of(swapped(turned(each.turn, {-1, 0, 0})),
                                  swapped(turned(each.turn, {0, 1, 0})),
                                  swapped(turned(each.turn, {0, 0, 1})));
    }
}

void lay_flat(TriangleMesh& mesh) {
    for (Vector3& point : mesh.positions) std::swap(point.y, point.z);
    for (Vector3& normal : mesh.normals) std::swap(normal.y, normal.z);
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

namespace {

/// Returns a mesh whose corners are the points (0, 0), (0, 1), (1, 1) and (1, 0) of the plane, as
/// fractions of its sides.
TriangleMesh floor_of(Vector3d extent) {
    const auto point = [](double x, double z) {
        return Vector3{static_cast<float>(x), 0, static_cast<float>(z)};
    };
    TriangleMesh mesh;
    mesh.positions = {point(0, 0), point(0, extent.y), point(extent.x, extent.y),
                      point(extent.x, 0)};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// Returns the colour of the floor where a ray hits it.
Colour light_of_floor(const Image& colours, const Hit& hit) {
    const std::array<float, 3> weights = hit.weights();
    const float x = hit.triangle == 0 ? weights[2] : weights[1] + weights[2];
    const float y = hit.triangle == 0 ? weights[1] + weights[2] : weights[1];
    const auto cell = [](float part, std::int64_t count) {
        const auto place = static_cast<std::int64_t>(part * static_cast<float>(count));
        return std::clamp<std::int64_t>(place, 0, count - 1);
    };
    return light_of(colours.at(cell(x, colours.width), cell(y, colours.height)));
}

/// Returns the light of a body where a ray hits it. The triangles of the body have been turned by
/// lay_flat().
Colour light_of_body(const DrawnCells& cells, const Hit& hit) {
    const auto& [a, b, c] = cells.body->triangles[hit.triangle];
    const std::array<std::uint32_t, 3> corners{a, c, b};
    const std::array<float, 3> weights = hit.weights();
    Colour sum{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const Colour light = light_of(cells.body_colours[corners[k]]);
        for (std::size_t part = 0; part < 3; ++part) sum[part] += weights[k] * light[part];
    }
    return sum;
}

}  // namespace

Image draw_cells(const DrawnCells& cells, std::span<const Colour> colours, const ModelCells* model,
                 ModelDrawer* drawer, const DrawOptions& options) {
    Instances copies = instances_of(cells, static_cast<double>(options.height), cells.detail);
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        copies.placements[k].colour = colours[cells.cells[k]];
    }
    DrawOptions used = options;
    TriangleMesh below;
    if (model != nullptr) {
        const ModelBox box(model->mesh);
        const auto stand_on = [&](const DrawnMesh& drawn) {
            move_instances(copies, box.in_script(drawn.middle), box.longest * drawn.scale);
        };
        if (cells.coat) {
            stand_on(drawer->drawn());
            return drawer->draw(*cells.coat, options, &copies);
        }
        DrawnMesh drawn = creased_mesh(model->mesh);
        stand_on(drawn);
        below = std::move(drawn.mesh);
    } else if (cells.body) {
        DrawnMesh drawn = creased_mesh(*cells.body);
        move_instances(copies, drawn.middle, drawn.scale);
        lay_flat(copies);
        lay_flat(drawn.mesh);
        below = std::move(drawn.mesh);
    } else {
        lay_flat(copies);
        if (cells.extent.z == 0) below = floor_of(cells.extent);
    }
    // There may be nothing to draw, because all cells have died or have the size 0.
    if (below.triangles.empty() && copies.triangle_count() == 0) {
        return empty_picture(options);
    }
    used.round_shadows = model != nullptr || cells.body;
    Team team(hardware_threads());
    const Scene scene(below.triangles.empty() ? nullptr : &below, &copies);
    const Colour skin = light_of(cells.skin);
    const SurfaceLook look = [&](const Sight& sight) {
        if (cells.body) return Look{light_of_body(cells, sight.hit), {}};
        return Look{cells.floor ? light_of_floor(*cells.floor, sight.hit) : skin, {}};
    };
    return draw(RayCaster(scene), look, used, team);
}

}  // namespace cascade
