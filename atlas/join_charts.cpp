// Works in rounds. A round sorts pairs of charts by the fraction of their outline that joining
// would remove, takes each chart in at most one pair, and tries to join all these pairs in
// parallel.
#include "atlas/join_charts.h"

#include "atlas/chart_box.h"
#include "atlas/chart_check.h"
#include "atlas/flatten.h"
#include "mesh/disjoint_sets.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace cascade {

namespace {

constexpr double most_mean = 1.10, most_bad = 0.01;
constexpr double small_area = 1.0 / 512;
/// Pairs with a smaller gain are not joined, since the connection between the charts would be
/// narrow.
constexpr double least_gain = 0.12;
// Limits of a chart's length, so that a square of area 1 has room for other charts beside it.
constexpr double longest_side = 1.5, longest_joined_side = 1.1;
constexpr double least_filled = 0.55, small_joined_area = 1.0 / 64;
/// The largest number of triangles of a joined chart. It limits the time.
constexpr std::size_t most_triangles = 250'000;
constexpr int rounds_of_trial = 8;

/// Two charts with a common border.
struct Pair {
    std::uint32_t one = 0, other = 0;
    double gain = 0;  ///< The length of the border as a fraction of the shorter outline.
    std::vector<TriangleEdge> edges;  ///< The border as edges of chart `one`.
};

class Joining {
public:
    Joining(const SurfaceMesh& mesh, std::vector<Chart> charts, Seams& seams,
            std::span<std::uint32_t> numbers)
        : mesh_(mesh),
          charts_(std::move(charts)),
          seams_(seams),
          numbers_(numbers),
          chart_of_(mesh.triangles.size()),
          is_used_(charts_.size(), 1) {
        for (std::uint32_t c = 0; c < charts_.size(); ++c) note(c);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const TriangleEdge other = mesh.across[t][k];
                if (seams[t][k] && other.exists() && t < other.triangle) border_.push_back({t, k});
            }
        }
    }

    std::vector<Chart> run(Team& team, const std::atomic<bool>& cancel) {
        while (!cancel) {
            const std::vector<Pair> pairs = chosen_pairs();
            if (pairs.empty()) break;
            std::vector<std::optional<Chart>> joined(pairs.size());
            in_turn(team, pairs.size(), cancel,
                    [&](std::size_t k) { joined[k] = try_to_join(pairs[k]); });
            if (cancel) break;
            for (std::size_t k = 0; k < pairs.size(); ++k) {
                if (joined[k]) replace(pairs[k], *std::move(joined[k]));
                else failed_.emplace(pairs[k].one, pairs[k].other);
            }
            std::erase_if(border_, [&](TriangleEdge e) { return !seams_[e.triangle][e.edge]; });
        }
        std::vector<Chart> rest;
        for (std::size_t c = 0; c < charts_.size(); ++c) {
            if (is_used_[c] != 0) rest.push_back(std::move(charts_[c]));
        }
        return rest;
    }

private:
    double length_of(TriangleEdge e) const {
        return length(mesh_.corner(e.triangle, corner_after(e.edge)) -
                      mesh_.corner(e.triangle, e.edge));
    }

    /// Records for the chart's triangles that they belong to this chart.
    void note(std::uint32_t chart) {
        for (const std::uint32_t t : charts_[chart].triangles) chart_of_[t] = chart;
    }
    void number(const Chart& chart) {
        for (std::uint32_t n = 0; n < chart.triangles.size(); ++n) {
            numbers_[chart.triangles[n]] = n;
        }
    }

    void replace(const Pair& pair, Chart joined) {
        for (const std::uint32_t old : {pair.one, pair.other}) {
            charts_[old] = {};
            is_used_[old] = 0;
        }
        charts_.push_back(std::move(joined));
        is_used_.push_back(1);
        note(static_cast<std::uint32_t>(charts_.size() - 1));
    }

    /// All pairs of charts with a common border, except pairs that could not be joined.
    std::vector<Pair> pairs() const {
        std::vector<double> outline(charts_.size());
        for (std::uint32_t c = 0; c < charts_.size(); ++c) {
            for (const std::uint32_t t : charts_[c].triangles) {
                for (std::uint32_t k = 0; k < 3; ++k) {
                    if (seams_[t][k]) outline[c] += length_of({t, k});
                }
            }
        }
        struct Common {
            std::uint32_t one, other;
            TriangleEdge edge;
        };
        std::vector<Common> common;
        for (const TriangleEdge edge : border_) {
            const TriangleEdge across = mesh_.across[edge.triangle][edge.edge];
            const std::uint32_t a = chart_of_[edge.triangle], b = chart_of_[across.triangle];
            if (a < b) common.push_back({a, b, edge});
            if (a > b) common.push_back({b, a, across});
        }
        std::stable_sort(common.begin(), common.end(), [](const Common& a, const Common& b) {
            return std::tie(a.one, a.other) < std::tie(b.one, b.other);
        });
        std::vector<Pair> pairs;
        for (const auto& [one, other, edge] : common) {
            if (pairs.empty() || pairs.back().one != one || pairs.back().other != other) {
                pairs.push_back({one, other, 0, {}});
            }
            pairs.back().gain += length_of(edge) / std::min(outline[one], outline[other]);
            pairs.back().edges.push_back(edge);
        }
        std::erase_if(pairs, [&](const Pair& pair) {
            return !(pair.gain >= least_gain) || failed_.contains({pair.one, pair.other}) ||
                   charts_[pair.one].triangles.size() + charts_[pair.other].triangles.size() >
                       most_triangles;
        });
        return pairs;
    }

    std::vector<Pair> chosen_pairs() const {
        std::vector<Pair> all = pairs(), chosen;
        std::stable_sort(all.begin(), all.end(),
                         [](const Pair& a, const Pair& b) { return a.gain > b.gain; });
        std::vector<std::uint8_t> is_taken(charts_.size());
        for (Pair& pair : all) {
            if (is_taken[pair.one] != 0 || is_taken[pair.other] != 0) continue;
            is_taken[pair.one] = is_taken[pair.other] = 1;
            chosen.push_back(std::move(pair));
        }
        return chosen;
    }

    void set_seam(std::span<const TriangleEdge> edges, bool is_seam) {
        for (const TriangleEdge edge : edges) {
            const TriangleEdge across = mesh_.across[edge.triangle][edge.edge];
            seams_[edge.triangle][edge.edge] = is_seam;
            seams_[across.triangle][across.edge] = is_seam;
        }
    }

    /// The longest part of a border along which neither chart has a cut.
    std::vector<TriangleEdge> longest_run(const Pair& pair) const {
        const std::vector<TriangleEdge>& border = pair.edges;
        struct End {
            /// The point's positions in both charts, and the index of an edge of the border.
            std::uint32_t here, there, edge;
        };
        std::vector<End> ends;
        for (std::uint32_t e = 0; e < border.size(); ++e) {
            const TriangleEdge across = mesh_.across[border[e].triangle][border[e].edge];
            const auto& here = charts_[pair.one].corners[numbers_[border[e].triangle]];
            const auto& there = charts_[pair.other].corners[numbers_[across.triangle]];
            ends.push_back({here[border[e].edge], there[corner_after(across.edge)], e});
            ends.push_back({here[corner_after(border[e].edge)], there[across.edge], e});
        }
        std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
            return std::tie(a.here, a.there, a.edge) < std::tie(b.here, b.there, b.edge);
        });
        DisjointSets runs(border.size());
        for (std::size_t k = 1; k < ends.size(); ++k) {
            if (ends[k].here == ends[k - 1].here && ends[k].there == ends[k - 1].there) {
                runs.join(ends[k].edge, ends[k - 1].edge);
            }
        }
        std::vector<double> lengths(border.size());
        for (std::uint32_t e = 0; e < border.size(); ++e) {
            lengths[runs.find(e)] += length_of(border[e]);
        }
        const auto longest = static_cast<std::uint32_t>(
            std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
        std::vector<TriangleEdge> run;
        for (std::uint32_t e = 0; e < border.size(); ++e) {
            if (runs.find(e) == longest) run.push_back(border[e]);
        }
        return run;
    }

    /// Joins two charts along the whole border or, if that fails, along its longest run. So two
    /// halves of a tube can become a sheet.
    std::optional<Chart> try_to_join(const Pair& pair) {
        if (auto joined = try_edges(pair, pair.edges)) return joined;
        number(charts_[pair.one]);
        number(charts_[pair.other]);
        const std::vector<TriangleEdge> run = longest_run(pair);
        if (run.size() == pair.edges.size()) return std::nullopt;
        return try_edges(pair, run);
    }

    std::optional<Chart> try_edges(const Pair& pair, std::span<const TriangleEdge> edges) {
        const Chart &one = charts_[pair.one], &other = charts_[pair.other];
        number(one);
        number(other);
        const Vector2d turn = turn_between(one, other, edges);
        set_seam(edges, false);
        std::vector<std::uint32_t> triangles = one.triangles;
        triangles.insert(triangles.end(), other.triangles.begin(), other.triangles.end());
        Chart joined = chart_of(mesh_, seams_, std::move(triangles), numbers_);
        joined.turns = one.turns;
        for (const Vector2d old : other.turns) joined.turns.push_back(product(turn, old));
        flatten(mesh_, joined, rounds_of_trial);
        if (is_good(mesh_, seams_, joined) && packs_well(joined)) return joined;
        set_seam(edges, true);
        return std::nullopt;
    }

    /// Whether a joined chart leaves no gaps around it that are hard to fill.
    bool packs_well(const Chart& joined) const {
        const Vector2d box = smallest_box(joined).size;
        double area = 0;
        for (const std::uint32_t t : joined.triangles) area += mesh_.area(t);
        return std::max(box.x, box.y) <= longest_joined_side &&
               (area <= small_joined_area || area >= least_filled * box.x * box.y);
    }

    /// The rotation that turns the edges of `other` onto the edges of `one`.
    Vector2d turn_between(const Chart& one, const Chart& other,
                          std::span<const TriangleEdge> edges) const {
        const auto along = [&](const Chart& chart, TriangleEdge e) {
            const FlatTriangle flat = chart.flat(numbers_[e.triangle]);
            return flat[corner_after(e.edge)] - flat[e.edge];
        };
        Vector2d sum{};
        for (const TriangleEdge edge : edges) {
            const Vector2d here = along(one, edge);
            const Vector2d there = along(other, mesh_.across[edge.triangle][edge.edge]) * -1;
            sum = sum + Vector2d{dot(there, here), cross(there, here)};
        }
        const Vector2d turn = unit_of(sum);
        return length(turn) > 0 ? turn : Vector2d{1, 0};
    }

    const SurfaceMesh& mesh_;
    std::vector<Chart> charts_;
    Seams& seams_;
    std::span<std::uint32_t> numbers_;
    std::vector<std::uint32_t> chart_of_;  ///< The chart of each triangle.
    /// 1 until the chart has been joined to another one, then 0.
    std::vector<std::uint8_t> is_used_;
    /// Edges with a seam. Only one side of each edge is listed.
    std::vector<TriangleEdge> border_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> failed_;
};

}  // namespace

bool is_good(const SurfaceMesh& mesh, const Seams& seams, const Chart& chart) {
    if (!is_injective(seams, chart)) return false;
    const Vector2d box = smallest_box(chart).size;
    if (std::max(box.x, box.y) > longest_side) return false;
    const ChartStretch stretch = stretch_of(mesh, chart);
    return stretch.area < small_area || (stretch.mean <= most_mean && stretch.bad <= most_bad);
}

std::vector<Chart> join_charts(const SurfaceMesh& mesh, std::vector<Chart> charts, Seams& seams,
                               std::span<std::uint32_t> numbers, Team& team,
                               const std::atomic<bool>& cancel) {
    return Joining(mesh, std::move(charts), seams, numbers).run(team, cancel);
}

}  // namespace cascade
