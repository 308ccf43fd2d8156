// Rounds of repulsion on neighbour lists with a skin (Verlet lists, as in molecular dynamics),
// rebuilt when places have moved too far.
#include "surface/relax.h"

#include "core/hash.h"
#include "surface/point_index.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace cascade {

namespace {

constexpr double strength = 0.15;
/// The neighbour lists reach this much farther than the force, in radii.
constexpr double skin = 0.25;
/// The longest move of a place in a round, in radii. On folded surfaces, places have many
/// neighbours and would oscillate without this limit.
constexpr double longest_step = 0.06;
/// Two places nearer than this, in radii, are pushed apart harder: by a force that only grows
/// linearly towards 0, other places could press them together for good. Even places are 0.54 apart.
constexpr float core = 0.35F, core_strength = 4;
/// Lists are rebuilt when more than one in this many places has moved half the skin. A few places
/// always move far, and exact lists for them do not improve evenness.
constexpr std::size_t places_per_far_one = 100;
/// A list serves one in this many of the rounds done or more: the first ones move places farthest.
constexpr int rounds_per_age = 4;
/// At the end, places with another one nearer than `crowd` radii are pushed in separate rounds.
constexpr int settling_rounds = 12;
constexpr double crowd = 0.4;

struct Vector2f {
    float x = 0, y = 0;
};

/// A neighbour of a place: its position when the list was made, in radii and in the frame of the
/// place at that time, and the rotation of its own frame relative to that.
struct Other {
    std::uint32_t number = 0;
    Vector2f stood;
    Vector2f turn;
};

/// The direction in which a place is pushed apart from one that coincides with it.
Vector2d own_direction(std::uint32_t number) {
    const double angle = 2 * std::numbers::pi / 4294967296.0 * pcg4d({number, 0, 0, 0})[0];
    return {std::cos(angle), std::sin(angle)};
}

class Relaxation {
public:
    Relaxation(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, Team& team,
               const std::atomic<bool>& cancel, const Anisotropy* anisotropy)
        : mesh_(mesh),
          places_(places),
          team_(team),
          cancel_(cancel),
          anisotropy_(anisotropy),
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
        RowRange range;             ///< In `active_`.
        std::vector<Other> others;  ///< Place after place.
        std::size_t far_moved = 0;  ///< Places that have moved half the skin or more since.
        std::vector<std::uint32_t> crowded;  ///< Unsorted, with repetitions.
    };

    Part& part_of(int thread) {
        Part& part = parts_[static_cast<std::size_t>(thread)];
        part.range = split_rows(static_cast<std::int64_t>(active_.size()), thread, team_.size());
        return part;
    }

    Stretch stretch_at(const SurfacePlace& place) const {
        return anisotropy_ ? anisotropy_->of(mesh_, place.triangle) : Stretch{};
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
                index.near(positions_[k], crowd * radius_, [&](std::uint32_t other) {
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

    /// The list of all places reaches this far.
    double reach() const { return (1 + skin) * radius_; }

    /// Updates the positions of the active places and sorts all of them.
    PointIndex index_places() {
        for (const std::uint32_t k : active_) positions_[k] = position_of(mesh_, places_[k]);
        return {positions_, reach()};
    }

    /// Rebuilds the lists of the active places.
    void find_others(const PointIndex& index) {
        team_.run([&](int thread) {
            Part& part = part_of(thread);
            part.others.clear();
            Unfolding unfolding(mesh_, shapes_);
            for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
                const auto n = static_cast<std::size_t>(row);
                const std::uint32_t k = active_[n];
                const double ratio = anisotropy_ ? anisotropy_->ratio_of(places_[k].triangle) : 1;
                find_others_of(k, index, reach() * std::sqrt(ratio), unfolding, part);
                ends_[n] = part.others.size();
                turns_[k] = {1, 0};
                moved_[k] = {};
            }
        });
    }

    void find_others_of(std::uint32_t k, const PointIndex& index, double reach,
                        Unfolding& unfolding, Part& part) const {
        unfolding.around(places_[k], reach);
        index.near(positions_[k], reach, [&](std::uint32_t number) {
            const FlatTriangle* flat = unfolding.flat_of(places_[number].triangle);
            if (number == k || !flat) return;
            const Vector2d stood = position_of(*flat, places_[number].weights);
            const double square = dot(stood, stood);
            const Vector3d apart = positions_[number] - positions_[k];
            if (square > reach * reach || !Unfolding::is_image(square, dot(apart, apart))) return;
            const Vector2d base = (*flat)[1] - (*flat)[0];
            part.others.push_back(
                {number, in_float(stood * (1 / radius_)), in_float(base * (1 / length(base)))});
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
        const Other* other = part.others.data();
        for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
            const auto n = static_cast<std::size_t>(row);
            const std::uint32_t k = active_[n];
            const Other* end = part.others.data() + ends_[n];
            const Stretch stretch = stretch_at(places_[k]).in_frame({turns_[k].x, -turns_[k].y});
            Vector2d pushed = push_on(k, {other, end}, stretch) * strength;
            const double size = length(pushed);
            if (size > longest_step) pushed = pushed * (longest_step / size);
            const Vector2d step = stretch.inverse()(pushed);
            const WalkEnd walked = walk(mesh_, places_[k], turned_into(step, turns_[k]) * radius_);
            const Vector2d now = Vector2d{moved_[k].x, moved_[k].y} + step * walked.part;
            moving_[k] = in_float(now);
            part.far_moved += 2 * length(stretch(now)) > skin;
            places_[k] = walked.place;
            turns_[k] = product(turns_[k], walked.turn);
            other = end;
        }
    }

    /// The sum of the forces on a place in the anisotropic metric, in radii.
    Vector2d push_on(std::uint32_t k, std::span<const Other> others, const Stretch& stretch) const {
        const Vector2f here = moved_[k];
        const auto xx = static_cast<float>(stretch.xx), xy = static_cast<float>(stretch.xy),
                   yy = static_cast<float>(stretch.yy);
        Vector2f push;
        for (const Other& other : others) {
            const Vector2f by = moved_[other.number], turn = other.turn;
            const float x = other.stood.x + turn.x * by.x - turn.y * by.y - here.x;
            const float y = other.stood.y + turn.y * by.x + turn.x * by.y - here.y;
            const float u = xx * x + xy * y, v = xy * x + yy * y;
            const float square = u * u + v * v;
            if (square >= 1) continue;
            const float distance = std::sqrt(square);
            Vector2f away = {-u / distance, -v / distance};
            if (distance < 1e-7F) away = in_float(own_direction(k));
            const float size = 1 - distance + core_strength * std::max(0.0F, core - distance);
            push.x += away.x * size;
            push.y += away.y * size;
        }
        return {push.x, push.y};
    }

    const SurfaceMesh& mesh_;
    std::vector<SurfacePlace>& places_;
    Team& team_;
    const std::atomic<bool>& cancel_;
    const Anisotropy* anisotropy_;
    double radius_;
    EdgeShapes shapes_;
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
