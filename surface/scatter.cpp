#include "surface/scatter.h"

#include "core/hash.h"
#include "surface/point_index.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr double strength = 0.15;

/// In (0, 1).
double uniform(std::uint32_t word) { return (word + 0.5) / 4294967296.0; }

/// Of two random numbers a place in a triangle (G. Turk, "Generating random points in triangles",
/// Graphics Gems, 1990).
std::array<double, 3> place_in_triangle(double s, double t) {
    const double root = std::sqrt(t);
    return {1 - root, (1 - s) * root, s * root};
}

std::vector<double> areas_up_to(const SurfaceMesh& mesh) {
    std::vector<double> sums;
    sums.reserve(mesh.triangles.size());
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sums.push_back(sum += mesh.area(t));
    return sums;
}

/// Where a place is pushed to by those around it. Places that coincide are pushed apart in a
/// direction of each one's own.
class Repulsion {
public:
    Repulsion(const SurfaceMesh& mesh, const std::vector<SurfacePlace>& places,
              const PointIndex& index, double radius)
        : mesh_(mesh), places_(places), index_(index), radius_(radius), unfolding_(mesh) {}

    SurfacePlace pushed(std::uint32_t number, Vector3d position) {
        const SurfacePlace& place = places_[number];
        unfolding_.around(place, radius_);
        Vector2d push;
        index_.near(position, [&](std::uint32_t other) {
            const FlatTriangle* flat = unfolding_.flat_of(places_[other].triangle);
            if (other == number || !flat) return;
            const Vector2d from = position_of(*flat, places_[other].weights);
            const double distance = length(from);
            if (distance >= radius_) return;
            const Vector2d away = distance > 1e-9 * radius_ ? from * (-1 / distance)
                                                            : own_direction(number);
            push = push + away * (radius_ - distance);
        });
        return walk(mesh_, place, push * strength);
    }

private:
    static Vector2d own_direction(std::uint32_t number) {
        const double angle = 2 * std::numbers::pi * uniform(pcg4d({number, 0, 0, 0})[0]);
        return {std::cos(angle), std::sin(angle)};
    }

    const SurfaceMesh& mesh_;
    const std::vector<SurfacePlace>& places_;
    const PointIndex& index_;
    double radius_;
    Unfolding unfolding_;
};

}  // namespace

double repulsion_radius(double area, std::size_t count) {
    return 2 * std::sqrt(area / static_cast<double>(count));
}

std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed) {
    const std::vector<double> sums = areas_up_to(mesh);
    std::vector<SurfacePlace> places;
    places.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto [strip, s, t, unused] =
            pcg4d({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k >> 32), seed, 1});
        const double share = (static_cast<double>(k) + uniform(strip)) / static_cast<double>(count);
        const auto found = std::upper_bound(sums.begin(), sums.end(), share * sums.back());
        const auto triangle = std::min<std::size_t>(found - sums.begin(), sums.size() - 1);
        places.push_back({static_cast<std::uint32_t>(triangle),
                          place_in_triangle(uniform(s), uniform(t))});
    }
    return places;
}

void relax(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, int rounds, Team& team,
           const std::atomic<bool>& cancel) {
    if (places.empty()) return;
    const double radius = repulsion_radius(mesh.total_area(), places.size());
    std::vector<Vector3d> positions(places.size());
    std::vector<SurfacePlace> moved(places.size());
    for (int round = 0; round < rounds && !cancel; ++round) {
        for (std::size_t k = 0; k < places.size(); ++k) positions[k] = position_of(mesh, places[k]);
        const PointIndex index(positions, radius);
        team.run([&](int thread) {
            const RowRange part =
                split_rows(static_cast<std::int64_t>(places.size()), thread, team.size());
            Repulsion repulsion(mesh, places, index, radius);
            for (auto k = static_cast<std::size_t>(part.begin);
                 k < static_cast<std::size_t>(part.end) && !cancel; ++k) {
                moved[k] = repulsion.pushed(static_cast<std::uint32_t>(k), positions[k]);
            }
        });
        if (!cancel) places.swap(moved);
    }
}

}  // namespace cascade
