// Rounds weights to integral steps. Moves coinciding positions to the next free points of a spiral.
#include "surface/place_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <set>

namespace cascade {

namespace {

constexpr double weight_tolerance = 1e-6;
/// The number of lattice steps between separated positions.
constexpr std::int64_t stride = 1 << 6;

bool is_on(const SurfaceMesh& mesh, const SurfacePlace& place) {
    double sum = 0;
    for (const double weight : place.weights) {
        if (!(weight >= -weight_tolerance)) return false;
        sum += weight;
    }
    return place.triangle < mesh.triangles.size() && std::abs(sum - 1) <= weight_tolerance;
}

std::int64_t rounded(double weight) {
    return std::clamp(std::llround(weight * static_cast<double>(lattice_steps)), 0LL,
                      static_cast<long long>(lattice_steps));
}

LatticePlace nearest(const SurfacePlace& place) {
    const std::int64_t first = rounded(place.weights[0]);
    const std::int64_t second = std::min(rounded(place.weights[1]), lattice_steps - first);
    return {place.triangle, {first, second, lattice_steps - first - second}};
}

/// A key that identifies a position. Positions that coincide have equal keys even if they are given
/// in different triangles. A key consists of a point, or of an edge and the position along it, or
/// of a triangle and the steps in it.
struct Key {
    int kind = 0;
    std::uint32_t owner = 0, edge = 0;
    std::int64_t first = 0, second = 0;
    auto operator<=>(const Key&) const = default;
};

Key key_of(const SurfaceMesh& mesh, const LatticePlace& place) {
    if (const std::uint32_t k = place.corner(); k < 3) {
        return {0, mesh.triangles[place.triangle][k], 0, 0, 0};
    }
    if (const std::uint32_t k = place.edge(); k < 3) {
        const TriangleEdge other = mesh.across[place.triangle][k];
        if (!other.exists() ||
            std::pair(place.triangle, k) < std::pair(other.triangle, other.edge)) {
            return {1, place.triangle, k, place.steps[k], 0};
        }
        return {1, other.triangle, other.edge, place.steps[corner_after(k)], 0};
    }
    return {2, place.triangle, 0, place.steps[0], place.steps[1]};
}

/// Point k = 1, 2, … of a spiral around (0, 0) through all points with integer coordinates.
std::array<std::int64_t, 2> on_spiral(std::int64_t k) {
    // The larger absolute coordinate. (2 ring − 1)² points come before the points with this
    // coordinate.
    const auto ring = static_cast<std::int64_t>((std::sqrt(static_cast<double>(k)) + 1) / 2);
    const std::int64_t along = k - (2 * ring - 1) * (2 * ring - 1), side = 2 * ring;
    const std::int64_t part = along % side;
    switch (along / side) {
        case 0: return {ring, part - ring + 1};
        case 1: return {ring - 1 - part, ring};
        case 2: return {-ring, ring - 1 - part};
        default: return {part - ring + 1, -ring};
    }
}

/// Separates coinciding positions.
class Separation {
public:
    Separation(const SurfaceMesh& mesh, std::vector<LatticePlace>& places)
        : mesh_(mesh), places_(places) {
        for (std::uint32_t k = 0; k < places.size(); ++k) {
            order_.emplace_back(key_of(mesh, places[k]), k);
        }
        std::sort(order_.begin(), order_.end());
    }

    void separate() {
        // The index on the spiral of the last point tried. For the next coinciding position, the
        // search continues from there.
        std::int64_t tried = 0;
        for (std::size_t k = 1; k < order_.size(); ++k) {
            if (order_[k].first != order_[k - 1].first) tried = 0;
            else move_away(places_[order_[k].second], tried);
        }
    }

private:
    void move_away(LatticePlace& place, std::int64_t& tried) {
        const Steps from = place.steps;
        for (;;) {
            const auto [first, second] = on_spiral(++tried);
            place.steps[0] = from[0] + stride * first;
            place.steps[1] = from[1] + stride * second;
            place.steps[2] = lattice_steps - place.steps[0] - place.steps[1];
            if (*std::min_element(place.steps.begin(), place.steps.end()) <= 0) continue;
            const Key key = key_of(mesh_, place);
            if (!is_taken(key) && moved_.insert(key).second) return;
        }
    }
    bool is_taken(const Key& key) const {
        const auto found = std::lower_bound(order_.begin(), order_.end(), std::pair(key, 0u));
        return found != order_.end() && found->first == key;
    }

    const SurfaceMesh& mesh_;
    std::vector<LatticePlace>& places_;
    std::vector<std::pair<Key, std::uint32_t>> order_;
    std::set<Key> moved_;
};

}  // namespace

std::uint32_t LatticePlace::corner() const {
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (steps[k] == lattice_steps) return k;
    }
    return 3;
}

std::uint32_t LatticePlace::edge() const {
    if (corner() < 3) return 3;
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (steps[corner_before(k)] == 0) return k;
    }
    return 3;
}

Steps steps_across(const Steps& steps, std::uint32_t edge, std::uint32_t edge_there) {
    Steps across{};
    across[edge_there] = steps[corner_after(edge)];
    across[corner_after(edge_there)] = steps[edge];
    return across;
}

Result<std::vector<LatticePlace>> to_lattice(const SurfaceMesh& mesh,
                                             std::span<const SurfacePlace> places) {
    std::vector<LatticePlace> found;
    found.reserve(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (!is_on(mesh, places[k])) {
            return failure(fmt::format("position {}, counted from 0, is not on the surface", k));
        }
        found.push_back(nearest(places[k]));
    }
    Separation(mesh, found).separate();
    return found;
}

}  // namespace cascade
