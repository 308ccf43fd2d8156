// Traces rays in the coordinates of the drawn mesh, in which the longest side is 1.
#include "run/pictures/cells_from_outside.h"

#include "picture/srgb.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// Rays begin at this distance from the surface, so that they do not hit it at their own
/// beginnings.
constexpr float clearance = 1e-5F;

Vector3d in_double(const Vector3& a) {
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

/// Returns a distance from the surface that no part of a copy exceeds. It is twice the largest
/// distance in any copy between the copy's position and a corner of its box, because copies may be
/// above the surface.
float farthest_of(const Instances& copies) {
    std::vector<Vector3> corners;  // For each mesh, the largest absolute value of each coordinate.
    for (const TriangleMesh& mesh : copies.meshes) {
        Vector3 corner;
        for (const Vector3& p : mesh.positions) {
            corner = {std::max(corner.x, std::abs(p.x)), std::max(corner.y, std::abs(p.y)),
                      std::max(corner.z, std::abs(p.z))};
        }
        corners.push_back(corner);
    }
    float farthest = 0;
    for (const Placement& each : copies.placements) {
        const Vector3 corner = corners[each.mesh], scale = single(each.scale);
        farthest =
            std::max(farthest,
                     length(Vector3{corner.x * scale.x, corner.y * scale.y, corner.z * scale.z}));
    }
    return 2 * farthest;
}

}  // namespace

CellsFromOutside::CellsFromOutside(const SurfaceMesh& mesh, Instances copies)
    : mesh_(mesh),
      normals_(corner_normals(mesh)),
      drawn_(creased_mesh(mesh)),
      copies_(std::move(copies)) {
    if (copies_.triangle_count() == 0) return;
    move_instances(copies_, drawn_.middle, drawn_.scale);
    farthest_ = farthest_of(copies_);
    of_surface_.emplace(drawn_.mesh);
    of_copies_.emplace(Scene(nullptr, &copies_));
}

std::optional<CellsFromOutside::Thing> CellsFromOutside::above(const SurfacePlace& place) const {
    if (!of_copies_) return std::nullopt;
    const Vector3 foot = single((position_of(mesh_, place) - drawn_.middle) * drawn_.scale);
    const Vector3 outwards = single(normals_.at(mesh_, place));
    float reach = farthest_;
    if (const auto other = of_surface_->nearest({foot + outwards * clearance, outwards})) {
        reach = std::min(reach, (other->distance + clearance) / 2);
    }
    const auto hit = of_copies_->nearest({foot + outwards * reach, -outwards});
    if (!hit || hit->distance > reach) return std::nullopt;
    const Scene::Facet facet = of_copies_->scene().facet(*hit);
    const std::array<float, 3> weights = hit->weights();
    Vector3 normal;
    for (std::size_t k = 0; k < 3; ++k) normal = normal + facet.normals[k] * weights[k];
    Thing thing;
    thing.light = light_of(copies_.placements[hit->copy].colour);
    for (float& channel : thing.light) channel *= facet.shade;
    thing.height = static_cast<double>(reach - hit->distance) / drawn_.scale;
    thing.normal = in_double(unit(normal));
    return thing;
}

OutsideSamples::OutsideSamples(const CellsFromOutside& cells, const SkinColours& skin)
    : cells_(cells), skin_(light_of(skin.colour)) {
    if (skin.filter != nullptr) coat_.emplace(*skin.filter, skin.coat);
}

void OutsideSamples::paint(const SampleRow& row) {
    for (std::size_t k = 0; k < row.lights.size(); ++k) {
        const SurfacePlace place = row.place(k);
        const auto thing = cells_.above(place);
        row.heights[k] = thing ? static_cast<float>(thing->height) : 0;
        if (thing) row.lights[k] = thing->light;
        else row.lights[k] = coat_ ? light_of(coat_->at(place).colour) : skin_;
    }
}

Vector3d OutsideSamples::raised_normal(std::span<const SurfacePlace> samples,
                                       const Vector3d& normal) {
    Vector3d sum;
    for (const SurfacePlace& place : samples) {
        const auto thing = cells_.above(place);
        sum = sum + (thing ? thing->normal : normal);
    }
    return sum;
}

}  // namespace cascade
