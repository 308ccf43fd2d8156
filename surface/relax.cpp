// Rounds of repulsion on neighbour lists with a skin (Verlet lists, as in molecular dynamics). The
// lists are rebuilt when positions have moved too far.
#include "surface/relax.h"

#include "core/hash.h"
#include "core/vector2.h"
#include "core/wide_vectors.h"
#include "surface/point_index.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace cascade {

namespace {

// The force that spreads positions over a surface.

/// Two positions nearer to each other than this, in radii, are pushed apart harder, with a force
/// that grows linearly as they approach. Without this force, other positions could press them
/// together permanently. Uniformly spread positions are 0.54 apart.
inline constexpr float repulsion_core = 0.35F;

struct Vector2f {
    float x = 0, y = 0;
};

/// Neighbours of positions: their numbers, their relative positions when the list was made (in
/// radii, in the frame of that time), and the rotations from that frame to the neighbours' own
/// frames.
class NeighbourList {
public:
    /// Forces are computed for this many neighbours at a time, so a list has memory for this many
    /// more neighbours beyond its end.
    static constexpr std::size_t together = 16;

    std::vector<std::uint32_t> numbers;
    std::vector<float> stood_x, stood_y, turn_x, turn_y;

    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    void add(std::uint32_t number, Vector2d stood, Vector2d turn);

private:
    std::size_t size_ = 0;
};

/// Sums forces. One object per thread.
class Repulsion {
public:
    /// The metric at a position and its movement since the list was made, in radii.
    struct Pushed {
        std::uint32_t number = 0;
        float xx = 1, xy = 0, yy = 1;
        Vector2f moved;
    };

    /// The sum, in order, of the forces of neighbours `first` … `end` - 1. A neighbour at the
    /// distance d < 1 in the metric has the force 1 - d. `moved` has the movement of every
    /// position.
    Vector2f push_on(const Pushed& place, const NeighbourList& neighbours, std::size_t first,
                     std::size_t end, const std::vector<Vector2f>& moved);

private:
    /// The movements of neighbours, later replaced by the neighbours' forces.
    std::vector<float> x_, y_;
};

constexpr float core_strength = 4;
/// Positions whose squared distance in radii is smaller than this count as coinciding.
constexpr float least_square = 1e-14F;

/// The direction in which a position is pushed away from another position at the same point.
Vector2f own_direction(std::uint32_t number) {
    const double angle = 2 * std::numbers::pi / 4294967296.0 * pcg4d({number, 0, 0, 0})[0];
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// Replaces the movements of `count` neighbours from `first` on by their forces on a position. A
/// coinciding neighbour pushes in the direction `apart`. Returns the number of coinciding
/// neighbours.
WITH_WIDE_VECTORS std::uint32_t find_forces(const NeighbourList& neighbours, std::size_t first,
                                            std::size_t count, const Repulsion::Pushed place,
                                            Vector2f apart, float* __restrict by_x,
                                            float* __restrict by_y) {
    const float* __restrict stood_x = neighbours.stood_x.data() + first;
    const float* __restrict stood_y = neighbours.stood_y.data() + first;
    const float* __restrict turn_x = neighbours.turn_x.data() + first;
    const float* __restrict turn_y = neighbours.turn_y.data() + first;
    std::uint32_t coincident = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const float x = stood_x[n] + turn_x[n] * by_x[n] - turn_y[n] * by_y[n] - place.moved.x;
        const float y = stood_y[n] + turn_y[n] * by_x[n] + turn_x[n] * by_y[n] - place.moved.y;
        const float u = place.xx * x + place.xy * y, v = place.xy * x + place.yy * y;
        const float square = u * u + v * v, distance = std::sqrt(square);
        const float closer = repulsion_core - distance;
        const float size = 1 - distance + core_strength * (closer > 0 ? closer : 0);
        const float away_x = square < least_square ? apart.x : -u / distance;
        const float away_y = square < least_square ? apart.y : -v / distance;
        by_x[n] = square < 1 ? away_x * size : 0;
        by_y[n] = square < 1 ? away_y * size : 0;
        coincident += square < least_square ? 1 : 0;
    }
    return coincident;
}

void NeighbourList::add(std::uint32_t number, Vector2d stood, Vector2d turn) {
    if (size_ + together >= numbers.size()) {
        const std::size_t room = 2 * size_ + 2 * together;
        numbers.resize(room);
        for (std::vector<float>* values : {&stood_x, &stood_y, &turn_x, &turn_y})
            values->resize(room);
    }
    numbers[size_] = number;
    stood_x[size_] = static_cast<float>(stood.x);
    stood_y[size_] = static_cast<float>(stood.y);
    turn_x[size_] = static_cast<float>(turn.x);
    turn_y[size_] = static_cast<float>(turn.y);
    ++size_;
}

Vector2f Repulsion::push_on(const Pushed& place, const NeighbourList& neighbours, std::size_t first,
                            std::size_t end, const std::vector<Vector2f>& moved) {
    // The last vector may also hold neighbours of the next position, whose forces are not used.
    constexpr std::size_t together = NeighbourList::together;
    const std::size_t count = end - first, filled = (count + together - 1) / together * together;
    if (x_.size() < filled) {
        x_.resize(filled);
        y_.resize(filled);
    }
    const auto find = [&](Vector2f apart) {
        for (std::size_t n = 0; n < count; ++n) {
            const Vector2f by = moved[neighbours.numbers[first + n]];
            x_[n] = by.x;
            y_[n] = by.y;
        }
        return find_forces(neighbours, first, filled, place, apart, x_.data(), y_.data());
    };
    if (find({}) > 0) find(own_direction(place.number));
    Vector2f push;
    for (std::size_t n = 0; n < count; ++n) {
        push.x += x_[n];
        push.y += y_[n];
    }
    return push;
}

constexpr double strength = 0.15;
/// The distance, in radii, by which the neighbour lists reach farther than the force.
constexpr double skin = 0.25;
/// The longest move of a position in a round, in radii. On folded surfaces, positions have many
/// neighbours and would oscillate without this limit.
constexpr double longest_step = 0.06;
/// Lists are rebuilt when more than one in this many positions has moved by half the skin. A few
/// positions always move far, but rebuilding the lists for them would not make the result more
/// uniform.
constexpr std::size_t places_per_far_one = 100;
/// Lists are rebuilt when their age in rounds exceeds the number of rounds so far divided by this.
/// So they are rebuilt often in early rounds, in which positions move farthest.
constexpr int rounds_per_age = 4;
/// The number of additional rounds at the end, in which only positions move that have another
/// position nearer than `crowd` radii.
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

    void run(int rounds, const std::function<void(double)>& progress) {
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
            if (progress) progress(static_cast<double>(round + 1) / rounds);
        }
        settle();
    }

private:
    /// The data of one thread.
    struct Part {
        RowRange range;            ///< A range of `active_`.
        NeighbourList neighbours;  ///< The neighbours of one position after another.
        Repulsion repulsion;
        /// Number of positions that have moved by half the skin or more.
        std::size_t far_moved = 0;
        /// The crowded positions, unsorted and with repetitions.
        std::vector<std::uint32_t> crowded;
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

    /// Separates positions that have come too near to each other because lists were outdated. All
    /// other positions stay.
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

    /// The positions, in ascending order, that have another position nearer than any positions that
    /// are spread uniformly. Only active positions may have moved since the last call.
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

    /// The search radius of all lists, in the metric of each list's position.
    double reach() const { return (1 + skin) * radius_; }

    /// Updates the active positions in space. Sorts all positions into boxes that are as wide as
    /// the usual reach of lists.
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

    /// Rebuilds the neighbour lists of the active positions.
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
    /// The stretch in each triangle. Empty if the metric is isotropic.
    std::vector<Stretch> stretches_;
    /// Changes since the lists were made, in the frame of that time: the rotation of the frame of
    /// each position's triangle, and the movement of the position (in radii). A round reads
    /// `moved_` and writes `moving_`.
    std::vector<Vector2d> turns_;
    std::vector<Vector2f> moved_, moving_;
    std::vector<Vector3d> positions_;    ///< Positions in space when the lists were made.
    std::vector<std::uint32_t> active_;  ///< The positions that move, in ascending order.
    /// The end of each active position's list in its thread's lists.
    std::vector<std::size_t> ends_;
    std::vector<Part> parts_;
};

}  // namespace

double repulsion_radius(double area, std::size_t count) {
    return 2 * std::sqrt(area / static_cast<double>(count));
}

void relax(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, int rounds, Team& team,
           const std::atomic<bool>& cancel, const Anisotropy* anisotropy,
           const std::function<void(double)>& progress) {
    if (places.size() < 2) return;
    Relaxation(mesh, places, team, cancel, anisotropy).run(rounds, progress);
}

}  // namespace cascade
