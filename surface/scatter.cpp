// Stratified sampling along a Morton curve. Within a connected component, each position has an
// equal share of the area, and its place within the share is random.
#include "surface/scatter.h"

#include "core/hash.h"
#include "core/morton.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace cascade {

namespace {

/// A number in (0, 1) from a random word.
double uniform(std::uint32_t word) { return (word + 0.5) / 4294967296.0; }

/// The triangles of one component after another. Within a component, triangles are in the order of
/// a Morton curve through the cube around the surface.
std::vector<std::uint32_t> in_order(const SurfaceMesh& mesh,
                                    const std::vector<std::uint32_t>& components) {
    const auto [low, high] = mesh.box();
    const Vector3d size = high - low;
    const double scale = 2097151 / std::max({size.x, size.y, size.z});
    std::vector<std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>> keys;
    keys.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3d at = (mesh.centroid(t) - low) * scale;
        keys.push_back({components[t],
                        morton_place(static_cast<std::uint64_t>(std::max(0.0, at.x)),
                                     static_cast<std::uint64_t>(std::max(0.0, at.y)),
                                     static_cast<std::uint64_t>(std::max(0.0, at.z))),
                        t});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const auto& key : keys) order.push_back(std::get<2>(key));
    return order;
}

/// The number of positions on each component: in proportion to its area, but at least 1 if there
/// are enough positions.
std::vector<std::size_t> shared_out(const std::vector<double>& areas, std::size_t count) {
    std::vector<std::size_t> shares(areas.size(), 0);
    double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::size_t left = count;
    // A component with a share below 1 gets one position. The other components share the remaining
    // positions. This may reduce the shares of more components to below 1.
    for (bool is_found = count >= areas.size(); is_found;) {
        is_found = false;
        const double each = area / static_cast<double>(left);
        for (std::size_t p = 0; p < areas.size(); ++p) {
            if (shares[p] != 0 || areas[p] >= each) continue;
            shares[p] = 1;
            --left;
            area -= areas[p];
            is_found = left > 0;
        }
    }
    double sum = 0;
    std::size_t before = 0, last = areas.size();
    for (std::size_t p = 0; p < areas.size(); ++p) {
        if (shares[p] == 0) last = p;
    }
    for (std::size_t p = 0; p < areas.size(); ++p) {
        if (shares[p] != 0) continue;
        sum += areas[p];
        const double part = std::round(sum / area * static_cast<double>(left));
        const std::size_t end = p == last ? left : std::min(left, static_cast<std::size_t>(part));
        shares[p] = end - before;
        before = end;
    }
    return shares;
}

}  // namespace

std::array<double, 3> place_in_triangle(double s, double t) {
    const double root = std::sqrt(t);
    return {1 - root, (1 - s) * root, s * root};
}

std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed,
                                  const std::vector<double>& component_areas) {
    const std::vector<std::uint32_t> components = connected_components(mesh);
    const std::vector<std::uint32_t> order = in_order(mesh, components);
    // Running sums of areas in the order of `order`, within each component.
    std::vector<double> sums;
    std::vector<std::size_t> ends;  // The ends of components in `sums`.
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool is_first = k == 0 || components[order[k]] != components[order[k - 1]];
        if (is_first && k > 0) ends.push_back(k);
        sums.push_back((is_first ? 0 : sums.back()) + mesh.area(order[k]));
    }
    ends.push_back(order.size());
    std::vector<double> areas;
    for (const std::size_t end : ends) areas.push_back(sums[end - 1]);
    const std::vector<std::size_t> shares =
        shared_out(component_areas.empty() ? areas : component_areas, count);

    std::vector<SurfacePlace> places;
    places.reserve(count);
    for (std::size_t p = 0; p < ends.size(); ++p) {
        const auto first = sums.begin() + static_cast<std::ptrdiff_t>(p == 0 ? 0 : ends[p - 1]);
        const auto last = sums.begin() + static_cast<std::ptrdiff_t>(ends[p]);
        for (std::size_t j = 0; j < shares[p]; ++j) {
            const std::uint64_t k = places.size();
            const auto [strip, s, t, unused] = pcg4d(
                {static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k >> 32), seed, 1});
            const double part =
                (static_cast<double>(j) + uniform(strip)) / static_cast<double>(shares[p]);
            const auto found = std::upper_bound(first, last - 1, part * areas[p]);
            places.push_back({order[static_cast<std::size_t>(found - sums.begin())],
                              place_in_triangle(uniform(s), uniform(t))});
        }
    }
    return places;
}

}  // namespace cascade
