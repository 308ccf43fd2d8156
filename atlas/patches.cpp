// All patches grow at once, in ascending order of the cost of their paths (E. Dijkstra 1959).
#include "atlas/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace cascade {

namespace {

constexpr std::uint32_t none = 0xffffffff;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double flat_cost = 0.2;      ///< The cost of a path on flat parts, per unit of length.
constexpr double crease_cost = 0.5;    ///< The cost of crossing a crease of 90°, as a length.
constexpr double least_crease = 0.13;  ///< One minus the cosine of 30°.
/// The cosine of 50°. A triangle bends too much if the cosine between its normal and the patch's
/// mean normal is smaller.
constexpr double most_bent = 0.64;
constexpr double bent_share = 0.05;     ///< The fraction of a patch's area that may bend too much.
constexpr double least_divided = 5e-4;  ///< Patches with a smaller area are not divided.
constexpr int most_rounds = 40, settling_rounds = 3, most_passes = 8;
/// Division ends when at most one in this many patches bends too much.
constexpr std::ptrdiff_t enough = 10;

struct Seed {
    std::uint32_t node = 0;
    Vector3d axis;
};

/// Triangles as nodes of a graph.
struct Nodes {
    /// Normals have length 1, or 0 for triangles without area.
    std::vector<Vector3d> centres, normals;

    void add(const SurfaceMesh& mesh, std::uint32_t triangle) {
        centres.push_back(
            (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) *
            (1.0 / 3));
        normals.push_back(unit(mesh.double_area_normal(triangle)));
    }
    std::size_t size() const { return centres.size(); }
};

struct Growth {
    std::vector<std::uint32_t> owners;  ///< The seed from which each node was reached.
    std::vector<double> costs;
};

/// Grows patches from seeds. `neighbour(node, k)` is the node across edge k, or none.
template <typename Neighbour>
Growth grow(const Nodes& nodes, std::span<const Seed> seeds, const Neighbour& neighbour) {
    Growth growth{std::vector<std::uint32_t>(nodes.size(), none),
                  std::vector<double>(nodes.size(), infinity)};
    using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // Cost, node, seed.
    std::priority_queue<Step, std::vector<Step>, std::greater<>> waiting;
    for (std::uint32_t s = 0; s < seeds.size(); ++s) {
        growth.costs[seeds[s].node] = 0;
        waiting.emplace(0.0, seeds[s].node, s);
    }
    while (!waiting.empty()) {
        const auto [cost, node, seed] = waiting.top();
        waiting.pop();
        if (growth.owners[node] != none) continue;
        growth.owners[node] = seed;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = neighbour(node, k);
            if (next == none || growth.owners[next] != none) continue;
            const double bend = 1 - dot(seeds[seed].axis, nodes.normals[next]);
            const double crease = 1 - dot(nodes.normals[node], nodes.normals[next]);
            const double reached =
                cost + (flat_cost + bend) * length(nodes.centres[next] - nodes.centres[node]) +
                crease_cost * std::max(0.0, crease - least_crease);
            if (!(reached < growth.costs[next])) continue;
            growth.costs[next] = reached;
            waiting.emplace(reached, next, seed);
        }
    }
    return growth;
}

class BendPatches {
public:
    explicit BendPatches(const SurfaceMesh& mesh) : mesh_(mesh) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) nodes_.add(mesh, t);
        const std::vector<std::uint32_t> components = connected_components(mesh);
        for (std::uint32_t t = 0; t < components.size(); ++t) {
            if (components[t] == seeds_.size()) seeds_.push_back({t, nodes_.normals[t]});
        }
    }

    std::vector<std::uint32_t> run(const std::atomic<bool>& cancel) {
        const auto across = [&](std::uint32_t t, std::uint32_t k) {
            return mesh_.across[t][k].triangle;
        };
        const auto grow_again = [&] {
            growth_ = grow(nodes_, seeds_, across);
            measure();
        };
        grow_again();
        for (int round = 0; round < most_rounds && !cancel; ++round) {
            if (count_bent() * enough <= std::ssize(patches_)) break;
            move_seeds();
            divide_bent();
            grow_again();
        }
        for (int round = 0; round < settling_rounds && !cancel; ++round) {
            move_seeds();
            grow_again();
        }
        straighten();
        return std::move(growth_.owners);
    }

private:
    struct Patch {
        double area = 0, bent = 0;
        Vector3d sum, axis;  ///< The sum of normals times areas, and the direction of this sum.
        Vector3d centre;
        std::uint32_t middle = none, farthest = none;  ///< Indices of nodes.
    };

    void measure() {
        patches_.assign(seeds_.size(), {});
        visit([&](std::uint32_t t, Patch& patch) {
            const double area = mesh_.area(t);
            patch.area += area;
            patch.sum = patch.sum + nodes_.normals[t] * area;
            patch.centre = patch.centre + nodes_.centres[t] * area;
        });
        for (Patch& patch : patches_) {
            patch.axis = unit(patch.sum);
            if (patch.area > 0) patch.centre = patch.centre * (1 / patch.area);
        }
        visit([&](std::uint32_t t, Patch& patch) {
            if (dot(nodes_.normals[t], patch.axis) < most_bent) patch.bent += mesh_.area(t);
            const auto away = [&](std::uint32_t node) {
                return length(nodes_.centres[node] - patch.centre);
            };
            if (patch.middle == none || away(t) < away(patch.middle)) patch.middle = t;
            if (patch.farthest == none || growth_.costs[t] > growth_.costs[patch.farthest]) {
                patch.farthest = t;
            }
        });
    }

    template <typename Visit>
    void visit(const Visit& visit) {
        for (std::uint32_t t = 0; t < nodes_.size(); ++t) visit(t, patches_[growth_.owners[t]]);
    }

    /// Moves each triangle that juts out into another patch to that patch, if the triangle has two
    /// edges at the other patch and the seam becomes shorter. The patch that loses the triangle
    /// stays connected.
    void straighten() {
        std::vector<std::uint32_t>& owners = growth_.owners;
        const auto beyond = [&](std::uint32_t t, std::uint32_t k) {
            const std::uint32_t other = mesh_.across[t][k].triangle;
            return other == none ? none : owners[other];
        };
        const auto size = [&](std::uint32_t t, std::uint32_t k) {
            return length(mesh_.corner(t, corner_after(k)) - mesh_.corner(t, k));
        };
        bool has_changed = true;
        for (int pass = 0; has_changed && pass < most_passes; ++pass) {
            has_changed = false;
            for (std::uint32_t t = 0; t < owners.size(); ++t) {
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = corner_after(k), b = corner_before(k);
                    const std::uint32_t other = beyond(t, a);
                    if (other == none || other == owners[t] || beyond(t, b) != other ||
                        beyond(t, k) != owners[t] || size(t, a) + size(t, b) <= size(t, k)) {
                        continue;
                    }
                    owners[t] = other;
                    has_changed = true;
                    break;
                }
            }
        }
    }

    static bool is_bent(const Patch& patch) {
        return patch.area > least_divided && patch.bent > bent_share * patch.area &&
               patch.middle != patch.farthest;
    }
    std::ptrdiff_t count_bent() const {
        return std::count_if(patches_.begin(), patches_.end(), is_bent);
    }

    void move_seeds() {
        seeds_.clear();
        for (const Patch& patch : patches_) seeds_.push_back({patch.middle, patch.axis});
    }
    void divide_bent() {
        for (const Patch& patch : patches_) {
            if (is_bent(patch)) seeds_.push_back({patch.farthest, nodes_.normals[patch.farthest]});
        }
    }

    const SurfaceMesh& mesh_;
    Nodes nodes_;
    std::vector<Seed> seeds_;
    Growth growth_;
    std::vector<Patch> patches_;
};

std::uint32_t farthest_of(const Growth& growth) {
    const auto most = std::max_element(growth.costs.begin(), growth.costs.end());
    return static_cast<std::uint32_t>(most - growth.costs.begin());
}

}  // namespace

std::vector<std::uint32_t> bend_patches(const SurfaceMesh& mesh, const std::atomic<bool>& cancel) {
    return BendPatches(mesh).run(cancel);
}

std::array<std::vector<std::uint32_t>, 2> halves(const SurfaceMesh& mesh, const Seams& seams,
                                                 const Chart& chart,
                                                 std::span<const std::uint32_t> numbers) {
    Nodes nodes;
    for (const std::uint32_t triangle : chart.triangles) nodes.add(mesh, triangle);
    const auto neighbour = [&](std::uint32_t node, std::uint32_t k) {
        const std::uint32_t t = chart.triangles[node];
        return seams[t][k] ? none : numbers[mesh.across[t][k].triangle];
    };
    const auto seed = [&](std::uint32_t node) { return Seed{node, nodes.normals[node]}; };
    const Seed start = seed(0);
    const Seed one = seed(farthest_of(grow(nodes, {&start, 1}, neighbour)));
    std::array<Seed, 2> ends = {one, seed(farthest_of(grow(nodes, {&one, 1}, neighbour)))};
    // If all costs are equal, any other triangle can be the second end.
    if (ends[1].node == ends[0].node) ends[1] = seed(ends[0].node == 0 ? 1 : 0);
    const Growth growth = grow(nodes, ends, neighbour);
    std::array<std::vector<std::uint32_t>, 2> parts;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        parts[growth.owners[n]].push_back(chart.triangles[n]);
    }
    return parts;
}

}  // namespace cascade
