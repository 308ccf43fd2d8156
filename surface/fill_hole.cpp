// Always cuts off the ear whose circumcircle reaches least far. A priority queue finds this ear.
// Outdated ears in the queue are skipped.
#include "surface/fill_hole.h"

#include <algorithm>
#include <numbers>
#include <queue>

namespace cascade {

namespace {

/// A vertex that may be cut off. `reach` is outdated if the vertex's entry in `ages_` is no longer
/// `age`.
struct Ear {
    double reach = 0;
    std::uint32_t tip = 0, age = 0;
    friend bool operator<(const Ear& a, const Ear& b) {
        return a.reach != b.reach ? a.reach > b.reach : a.tip > b.tip;
    }
};

class EarCutter {
public:
    EarCutter(std::span<const Vector2d> ring, bool is_closed, const MayMake& may_make)
        : ring_(ring), is_closed_(is_closed), may_make_(may_make), ages_(ring.size()) {
        const auto count = static_cast<std::uint32_t>(ring.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            next_.push_back(k + 1 == count ? 0 : k + 1);
            previous_.push_back(k == 0 ? count - 1 : k - 1);
        }
    }

    std::vector<RingTriangle> cut() {
        const auto count = static_cast<std::uint32_t>(ring_.size());
        for (std::uint32_t k = 0; k < count && count > 3; ++k) consider(k);
        std::uint32_t any = 0;
        while (triangles_.size() + 3 < count) {
            if (ears_.empty()) return {};
            const Ear ear = ears_.top();
            ears_.pop();
            if (ear.age != ages_[ear.tip] || !may_make_(around(ear.tip))) continue;
            triangles_.push_back(around(ear.tip));
            any = take_off(ear.tip);
        }
        if (!may_make_(around(any))) return {};
        triangles_.push_back(around(any));
        return std::move(triangles_);
    }

private:
    RingTriangle around(std::uint32_t tip) const { return {previous_[tip], tip, next_[tip]}; }

    /// Removes a vertex and returns the vertex before it.
    std::uint32_t take_off(std::uint32_t tip) {
        const std::uint32_t before = previous_[tip], after = next_[tip];
        next_[before] = after;
        previous_[after] = before;
        ++ages_[tip];
        for (const std::uint32_t changed : {before, after}) {
            ++ages_[changed];
            consider(changed);
        }
        return before;
    }

    /// Queues the vertex `tip` if it is an ear. The whole ring is visible from the origin. So a
    /// triangle contains no other point of the ring if its third side passes through the origin or
    /// separates the triangle from the origin.
    void consider(std::uint32_t tip) {
        if (!is_closed_ && (tip == 0 || tip + 1 == ring_.size())) return;
        const Vector2d a = ring_[previous_[tip]], b = ring_[tip], c = ring_[next_[tip]];
        const double area = cross(b - a, c - a);
        const double ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
        if (!(area > 0) || ca > 0) return;
        const double circle = dot(a, a) * bc + dot(b, b) * ca + dot(c, c) * ab;
        ears_.push({circle / area, tip, ages_[tip]});
    }

    std::span<const Vector2d> ring_;
    bool is_closed_;
    const MayMake& may_make_;
    std::vector<std::uint32_t> next_, previous_, ages_;
    std::priority_queue<Ear> ears_;
    std::vector<RingTriangle> triangles_;
};

}  // namespace

std::vector<Vector2d> unroll(std::span<const double> distances, std::span<const double> angles) {
    double sum = 0;
    for (const double angle : angles) sum += angle;
    const bool is_closed = angles.size() == distances.size();
    const double scale = sum > 0 ? (is_closed ? 2 : 1) * std::numbers::pi / sum : 0;
    std::vector<Vector2d> ring;
    double direction = 0;
    for (std::size_t k = 0; k < distances.size(); ++k) {
        ring.push_back({distances[k] * std::cos(direction), distances[k] * std::sin(direction)});
        if (k < angles.size()) direction += angles[k] * scale;
    }
    return ring;
}

std::vector<RingTriangle> cut_ears(std::span<const Vector2d> ring, bool is_closed,
                                   const MayMake& may_make) {
    return EarCutter(ring, is_closed, may_make).cut();
}

}  // namespace cascade
