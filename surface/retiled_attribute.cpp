// Only the new points have values at first. Each old point that remains gets the mean of its
// neighbours that already have a value, layer by layer. The first layer is the old points next to
// new points.
#include "surface/retile.h"

#include <algorithm>
#include <limits>
#include <map>

namespace cascade {

namespace {

/// For each point from `first` on, the points around it, each as often as they share a triangle.
std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours_from(const SurfaceMesh& mesh,
                                                                    std::size_t first) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangle[k] < first) continue;
            auto& around = neighbours[triangle[k]];
            around.push_back(triangle[(k + 1) % 3]);
            around.push_back(triangle[(k + 2) % 3]);
        }
    }
    return neighbours;
}

}  // namespace

PointAttribute attribute_of(const Retiled& retiled, std::string name,
                            std::span<const float> values) {
    PointAttribute attribute{std::move(name), {values.begin(), values.end()}};
    std::vector<float>& known = attribute.values;
    known.resize(retiled.mesh.points.size(), std::numeric_limits<float>::quiet_NaN());
    const auto neighbours = neighbours_from(retiled.mesh, values.size());

    constexpr std::uint32_t never = 0xffffffff;
    std::vector<std::uint32_t> round_of(known.size(), never);
    std::fill(round_of.begin(), round_of.begin() + static_cast<std::ptrdiff_t>(values.size()), 0);
    std::vector<std::uint32_t> front;
    for (const auto& [point, around] : neighbours) {
        for (const std::uint32_t other : around) {
            if (other >= values.size() || round_of[point] != never) continue;
            round_of[point] = 1;
            front.push_back(point);
        }
    }
    for (std::uint32_t round = 1; !front.empty(); ++round) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t point : front) {
            double sum = 0, count = 0;
            for (const std::uint32_t other : neighbours.at(point)) {
                if (round_of[other] < round) {
                    sum += known[other];
                    ++count;
                } else if (round_of[other] == never) {
                    round_of[other] = round + 1;
                    next.push_back(other);
                }
            }
            known[point] = static_cast<float>(sum / count);
        }
        front = std::move(next);
    }
    return attribute;
}

}  // namespace cascade
