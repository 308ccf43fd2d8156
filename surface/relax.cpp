// Rounds of repulsion on neighbour lists with a skin (Verlet lists, as in molecular dynamics),
// rebuilt when places have moved too far.
#include "surface/relax.h"

#include "core/hash.h"
#include "surface/point_index.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
          ends_(places.size()),
          parts_(static_cast<std::size_t>(team.size())) {}

    void run(int rounds) {
        std::size_t far_moved = places_.size();
        int made = -1;
        for (int round = 0; round < rounds && !cancel_; ++round) {
            if (far_moved > places_.size() / places_per_far_one &&
                round - made > round / rounds_per_age) {
                find_others();
                made = round;
            }
            team_.run([&](int thread) { push(part_of(thread)); });
            moved_.swap(moving_);
            far_moved = 0;
            for (const Part& part : parts_) far_moved += part.far_moved;
        }
        settle();
    }

private:
    /// The data of one thread.
    struct Part {
        RowRange range;
        std::vector<Other> others;  ///< Place after place.
        std::size_t far_moved = 0;  ///< Places that have moved half the skin or more since.
    };

    Part& part_of(int thread) {
        Part& part = parts_[static_cast<std::size_t>(thread)];
        part.range = split_rows(static_cast<std::int64_t>(places_.size()), thread, team_.size());
        return part;
    }

    Stretch stretch_at(const SurfacePlace& place) const {
        return anisotropy_ ? anisotropy_->of(mesh_, place.triangle) : Stretch{};
    }

    /// Separates places that outdated lists let collide; the others stay.
    void settle() {
        for (int round = 0; round < settling_rounds && !cancel_; ++round) {
            find_others(true);
            team_.run([&](int thread) { push(part_of(thread)); });
            moved_.swap(moving_);
        }
    }

    /// Whether another place is nearer than evenly spread places ever are.
    bool is_crowded(std::size_t k, std::span<const Vector3d> positions,
                    const PointIndex& index) const {
        bool crowded = false;
        index.near(positions[k], crowd * radius_,
                   [&](std::uint32_t other) { crowded |= other != k; });
        return crowded;
    }

    /// Rebuilds the lists; with `only_crowded`, makes those of all other places empty.
    void find_others(bool only_crowded = false) {
        std::vector<Vector3d> positions;
        positions.reserve(places_.size());
        for (const SurfacePlace& place : places_) positions.push_back(position_of(mesh_, place));
        const double reach = (1 + skin) * radius_;
        const PointIndex index(positions, reach);
        team_.run([&](int thread) {
            Part& part = part_of(thread);
            part.others.clear();
            Unfolding unfolding(mesh_, shapes_);
            for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
                const auto k = static_cast<std::size_t>(row);
                if (only_crowded && !is_crowded(k, positions, index)) {
                    stand_still(k, part);
                    continue;
                }
                const double ratio = anisotropy_ ? anisotropy_->ratio_of(places_[k].triangle) : 1;
                find_others_of(k, positions, index, reach * std::sqrt(ratio), unfolding, part);
            }
        });
    }

    void find_others_of(std::size_t k, std::span<const Vector3d> positions, const PointIndex& index,
                        double reach, Unfolding& unfolding, Part& part) {
        unfolding.around(places_[k], reach);
        index.near(positions[k], reach, [&](std::uint32_t number) {
            const FlatTriangle* flat = unfolding.flat_of(places_[number].triangle);
            if (number == k || !flat) return;
            const Vector2d stood = position_of(*flat, places_[number].weights);
            const double square = dot(stood, stood);
            const Vector3d apart = positions[number] - positions[k];
            if (square > reach * reach || !Unfolding::is_image(square, dot(apart, apart))) return;
            const Vector2d base = (*flat)[1] - (*flat)[0];
            part.others.push_back(
                {number, in_float(stood * (1 / radius_)), in_float(base * (1 / length(base)))});
        });
        stand_still(k, part);
    }

    /// Resets the movement of a place whose list has been made.
    void stand_still(std::size_t k, const Part& part) {
        ends_[k] = part.others.size();
        turns_[k] = {1, 0};
        moved_[k] = {};
    }

    static Vector2f in_float(Vector2d v) {
        return {static_cast<float>(v.x), static_cast<float>(v.y)};
    }

    void push(Part& part) {
        part.far_moved = 0;
        const Other* other = part.others.data();
        for (std::int64_t row = part.range.begin; row < part.range.end && !cancel_; ++row) {
            const auto k = static_cast<std::size_t>(row);
            const Other* end = part.others.data() + ends_[k];
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
    Vector2d push_on(std::size_t k, std::span<const Other> others, const Stretch& stretch) const {
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
            if (distance < 1e-7F) away = in_float(own_direction(static_cast<std::uint32_t>(k)));
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
    std::vector<std::size_t> ends_;  ///< The ends of the places' lists in those of their threads.
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
