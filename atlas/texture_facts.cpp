// Estimates the covered and the shared fraction from samples. All other facts are exact.
#include "atlas/texture_facts.h"

#include "atlas/chart.h"
#include "atlas/texture_layout.h"
#include "mesh/disjoint_sets.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

std::size_t count_charts(const SurfaceMesh& mesh) {
    DisjointSets charts(mesh.triangles.size());
    std::size_t count = mesh.triangles.size();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            const auto &here = mesh.texture[t], &there = mesh.texture[other.triangle];
            if (here[k] != there[corner_after(other.edge)] ||
                here[corner_after(k)] != there[other.edge] ||
                charts.find(t) == charts.find(other.triangle)) {
                continue;
            }
            charts.join(t, other.triangle);
            --count;
        }
    }
    return count;
}

void measure_stretch(const SurfaceMesh& mesh, TextureFacts& facts) {
    const auto image = [&](std::uint32_t t) {
        FlatTriangle flat;
        for (std::size_t k = 0; k < 3; ++k) {
            flat[k] = {static_cast<double>(mesh.texture[t][k][0]),
                       static_cast<double>(mesh.texture[t][k][1])};
        }
        return flat;
    };
    double area = 0, area_of_image = 0, mirrored = 0;
    const auto visit = [&](const auto& work) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            FlatTriangle flat = image(t);
            const double twice = double_area(flat);
            if (!std::isfinite(twice) || twice == 0) continue;
            if (twice < 0) {
                for (Vector2d& corner : flat) corner.x = -corner.x;
            }
            work(t, flat, twice);
        }
    };
    visit([&](std::uint32_t t, const FlatTriangle&, double twice) {
        area += mesh.area(t);
        area_of_image += std::abs(twice) / 2;
        if (twice < 0) mirrored += mesh.area(t);
    });
    if (!(area > 0) || !(area_of_image > 0)) return;
    facts.mirrored = mirrored / area;
    const double scale = std::sqrt(area / area_of_image);
    double sum = 0;
    visit([&](std::uint32_t t, FlatTriangle flat, double) {
        for (Vector2d& corner : flat) corner = corner * scale;
        const double own = distortion(stretches(shape_of(mesh, t), flat));
        if (!std::isfinite(own)) return;
        sum += own * mesh.area(t);
        facts.worst = std::max(facts.worst, own);
    });
    facts.mean = sum / area;
}

}  // namespace

TextureFacts texture_facts(const SurfaceMesh& mesh) {
    constexpr std::int64_t side = 1024;
    TextureFacts facts;
    facts.charts = count_charts(mesh);
    const TextureLayout layout(mesh, side, side);
    std::vector<std::uint32_t> owners(static_cast<std::size_t>(side * side));
    const TextureLayout::Overlap overlap = layout.find_owners(0, side, owners);
    const auto fraction = [&](std::int64_t samples) {
        return static_cast<double>(samples) / static_cast<double>(side * side);
    };
    facts.covered = 1 - fraction(std::count(owners.begin(), owners.end(), TextureLayout::nothing));
    facts.shared = fraction(overlap.shared);
    facts.without_area = layout.skipped().without_area;
    facts.without_place = layout.skipped().without_place;
    measure_stretch(mesh, facts);
    return facts;
}

}  // namespace cascade
