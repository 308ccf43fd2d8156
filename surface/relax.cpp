// Rounds of repulsion on neighbour lists with a skin (Verlet lists, as in molecular dynamics),
// rebuilt when places have moved too far.
#include "surface/relax.h"

#include "surface/point_index.h"
#include "surface/repulsion.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

constexpr double strength = 0.15;
/// The neighbour lists reach this much farther than the force, in radii.
constexpr double skin = 0.25;
/// The longest move of a place in a round, in radii. On folded surfaces, places have many
/// neighbours and would oscillate without this limit.
constexpr double longest_step = 0.06;
/// Lists are rebuilt when more than one in this many places has moved half the skin. A few places
/// always move far, and exact lists for them do not improve evenness.
constexpr std::size_t places_per_far_one = 100;
/// A list serves one in this many of the rounds done or more: the first ones move places farthest.
constexpr int rounds_per_age = 4;
/// At the end, places with another one nearer than `crowd` radii are pushed in separate rounds.
constexpr int settling_rounds = 12;
constexpr double crowd = 0.4;

class Relaxation {
public:
    Relaxation(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, Team& team,
               const std::atomic<bool>& cancel, const Anisotropy* anisotropy)
        : mesh_(mesh),
          places_(places),
          team_(team),
          cancel_(cancel),
          radius_(repulsion_radius(mesh.total_area(), places.size())),
          shapes_(mesh),
          turns_(places.size()),
          moved_(places.size()),
          moving_(places.size()),
          positions_(places.size()),
          active_(places.size()),
          ends_(places.size()),
          parts_(static_cast<std::size_t>(team.size())) {
        std::iota(active_.begin(), active_.end(), std::uint32_t{0});
        if (anisotropy == nullptr) return;
        for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
            stretches_.push_back(anisotropy->of(mesh, triangle));
        }
    }

    void run(int rounds) {
        std::size_t far_moved = places_.size();
        int made = -1;
        for (int round = 0; round < rounds && !cancel_; ++round) {
            if (far_moved > places_.size() / places_per_far_one &&
                round - made > round / rounds_per_age) {
                find_others(index_places());
                made = round;
            }
            push_all();
            moved_.swap(moving_);
            far_moved = 0;
            for (const Part& part : parts_) far_moved += part.far_moved;
        }
        settle();
    }

private:
    /// The data of one thread.
    struct Part {
        RowRange range;            ///< In `active_`.
        NeighbourList neighbours;  ///< Place after place.
        Repulsion repulsion;
        std::size_t far_moved = 0;  ///< Places that have moved half the skin or more since.
        std::vector<std::uint32_t> crowded;  ///< Unsorted, with repetitions.
    };

    Part& part_of(int thread) {
        Part& part = parts_[static_cast<std::size_t>(thread)];
        part.range = split_rows(static_cast<std::int64_t>(active_.size()), thread, team_.size());
        return part;
    }

    bool is_anisotropic() const { return !stretches_.empty(); }
    Stretch stretch_at(const SurfacePlace& place) const {
        return is_anisotropic() ? stretches_[place.triangle] : Stretch{};
    }

    /// Separates places that outdated lists let collide; the others stay.
    void settle() {
        // Lists are new in each round, so nothing has moved since they were made.
        std::fill(moved_.begin(), moved_.end(), Vector2f{});
        for (int round = 0; round < settling_rounds && !cancel_; ++round) {
            const PointIndex index = index_places();
            active_ = crowded_places(index);
            if (active_.empty()) return;
            find_others(index);
            push_all();
        }
    }

    /// All places nearer to another one than evenly spread places ever are, in ascending order, if
    /// only active places may have moved since the last call.
    std::vector<std::uint32_t> crowded_places(const PointIndex& index) {
        team_.run([&](int thread) {
            Part& part = part_of(thread);
            part.crowded.clear();
            for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
                const std::uint32_t k = active_[static_cast<std::size_t>(row)];
                index.near(positions_[k], crowd * radius_, [&](std::uint32_t other, double) {
                    if (other != k) part.crowded.insert(part.crowded.end(), {k, other});
                });
            }
        });
        std::vector<std::uint32_t> crowded;
        for (const Part& part : parts_) {
            crowded.insert(crowded.end(), part.crowded.begin(), part.crowded.end());
        }
        std::sort(crowded.begin(), crowded.end());
        crowded.erase(std::unique(crowded.begin(), crowded.end()), crowded.end());
        return crowded;
    }

    /// The lists of all places reach this far, in the metric of each.
    double reach() const { return (1 + skin) * radius_; }

    /// Updates the positions of the active places and sorts all of them, into boxes of the usual
    /// reach on the surface.
    PointIndex index_places() {
        for (const std::uint32_t k : active_) positions_[k] = position_of(mesh_, places_[k]);
        double side = reach();
        if (is_anisotropic()) {
            double sum = 0;
            for (const SurfacePlace& place : places_) sum += stretch_at(place).longest();
            side *= sum / static_cast<double>(places_.size());
        }
        return {positions_, side};
    }

    /// Rebuilds the lists of the active places.
    void find_others(const PointIndex& index) {
        team_.run([&](int thread) {
            Part& part = part_of(thread);
            part.neighbours.clear();
            Unfolding unfolding(mesh_, shapes_);
            for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
                const auto n = static_cast<std::size_t>(row);
                const std::uint32_t k = active_[n];
                find_others_of(k, index, unfolding, part);
                ends_[n] = part.neighbours.size();
                turns_[k] = {1, 0};
                moved_[k] = {};
            }
        });
    }

    void find_others_of(std::uint32_t k, const PointIndex& index, Unfolding& unfolding,
                        Part& part) const {
        const Stretch metric = stretch_at(places_[k]);
        double longest = reach();
        if (is_anisotropic()) {
            unfolding.around(places_[k], reach(), metric);
            longest *= metric.longest();
        } else {
            unfolding.around(places_[k], reach());
        }
        index.near(positions_[k], longest, [&](std::uint32_t number, double square_in_space) {
            const FlatTriangle* flat = unfolding.flat_of(places_[number].triangle);
            if (number == k || !flat) return;
            const Vector2d stood = position_of(*flat, places_[number].weights);
            const Vector2d seen = metric(stood);
            if (dot(seen, seen) > reach() * reach()) return;
            if (!Unfolding::is_image(dot(stood, stood), square_in_space)) return;
            const Vector2d base = (*flat)[1] - (*flat)[0];
            part.neighbours.add(number, stood * (1 / radius_), base * (1 / length(base)));
        });
    }

    static Vector2f in_float(Vector2d v) {
        return {static_cast<float>(v.x), static_cast<float>(v.y)};
    }

    void push_all() {
        team_.run([&](int thread) { push(part_of(thread)); });
    }

    void push(Part& part) {
        part.far_moved = 0;
        std::size_t first = 0;
        for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
            const auto n = static_cast<std::size_t>(row);
            const std::uint32_t k = active_[n];
            const Stretch stretch = stretch_at(places_[k]).in_frame({turns_[k].x, -turns_[k].y});
            const Repulsion::Pushed place = {k, static_cast<float>(stretch.xx),
                                             static_cast<float>(stretch.xy),
                                             static_cast<float>(stretch.yy), moved_[k]};
            const Vector2f push =
                part.repulsion.push_on(place, part.neighbours, first, ends_[n], moved_);
            Vector2d pushed = Vector2d{push.x, push.y} * strength;
            first = ends_[n];
            const double size = length(pushed);
            if (size > longest_step) pushed = pushed * (longest_step / size);
            const Vector2d step = stretch.inverse()(pushed);
            const WalkEnd walked = walk(mesh_, places_[k], turned_into(step, turns_[k]) * radius_);
            const Vector2d now = Vector2d{moved_[k].x, moved_[k].y} + step * walked.part;
            moving_[k] = in_float(now);
            part.far_moved += 2 * length(stretch(now)) > skin;
            places_[k] = walked.place;
            turns_[k] = product(turns_[k], walked.turn);
        }
    }

    const SurfaceMesh& mesh_;
    std::vector<SurfacePlace>& places_;
    Team& team_;
    const std::atomic<bool>& cancel_;
    double radius_;
    EdgeShapes shapes_;
    std::vector<Stretch> stretches_;  ///< By triangle; empty without an anisotropy.
    /// Since the lists were made, in the frame of that time: the rotation of the frame of each
    /// place's triangle, and the movement of the place (in radii). A round reads `moved_`, writes
    /// `moving_`.
    std::vector<Vector2d> turns_;
    std::vector<Vector2f> moved_, moving_;
    std::vector<Vector3d> positions_;    ///< When the lists were made.
    std::vector<std::uint32_t> active_;  ///< The places that move, in ascending order.
    std::vector<std::size_t> ends_;      ///< Of the active places' lists in those of their threads.
    std::vector<Part> parts_;
};

}  // namespace

double repulsion_radius(double area, std::size_t count) {
    return 2 * std::sqrt(area / static_cast<double>(count));
}

void relax(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, int rounds, Team& team,
           const std::atomic<bool>& cancel, const Anisotropy* anisotropy) {
    if (places.size() < 2) return;
    Relaxation(mesh, places, team, cancel, anisotropy).run(rounds);
}

}  // namespace cascade
