// One surface cut into triangles in several ways, for tests of results that must not depend on the
// triangles.
#pragma once

#include "core/hash.h"
#include "core/vector3.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {

/// Triangles that can be cut into smaller ones, which does not change the surface.
class Triangles {
public:
    /// A torus with the radii 1 and 0.4, made of 32 by 16 quadrilaterals, each cut into two
    /// triangles.
    static Triangles torus() {
        constexpr std::uint32_t around = 32, across = 16;
        Triangles made;
        for (std::uint32_t i = 0; i < around; ++i) {
            for (std::uint32_t j = 0; j < across; ++j) {
                const double a = 2 * std::numbers::pi * i / around,
                             b = 2 * std::numbers::pi * j / across;
                const double r = 1 + 0.4 * std::cos(b);
                made.points_.push_back({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
                const std::uint32_t right = (i + 1) % around * across, here = i * across;
                const std::uint32_t up = (j + 1) % across;
                made.triangles_.push_back({here + j, right + j, right + up});
                made.triangles_.push_back({here + j, right + up, here + up});
            }
        }
        return made;
    }

    /// Cuts each triangle into four equal ones.
    Triangles finer() const {
        Triangles made;
        made.points_ = points_;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        for (const Corners& t : triangles_) {
            Corners middle;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
                const auto [found, is_new] =
                    middles.try_emplace(edge, static_cast<std::uint32_t>(made.points_.size()));
                if (is_new)
                    made.points_.push_back((points_[edge.first] + points_[edge.second]) * 0.5);
                middle[k] = found->second;
            }
            made.triangles_.push_back(middle);
            for (std::size_t k = 0; k < 3; ++k) {
                made.triangles_.push_back({t[k], middle[k], middle[(k + 2) % 3]});
            }
        }
        return made;
    }

    /// Cuts most triangles into three around a point that often lies near an edge or a corner, and
    /// repeats this four times. The result has slivers beside triangles of very different sizes.
    Triangles worse() const {
        Triangles made = *this;
        for (std::uint32_t round = 0; round < 4; ++round) {
            const std::size_t count = made.triangles_.size();
            for (std::size_t n = 0; n < count; ++n) {
                const auto words = pcg4d({static_cast<std::uint32_t>(n), round, 17, 4});
                if (words[0] % 8 < 3) continue;
                const auto part = [&](std::size_t k) {
                    return std::pow(words[k] * 0x1p-32, 3) + 1e-3;
                };
                made.cut(n, {part(1), part(2), part(3)});
            }
        }
        return made;
    }

    /// Cuts one in eight thousand triangles into three around a point near a corner, so that two of
    /// the three are slivers.
    Triangles with_few_slivers() const {
        Triangles made = *this;
        for (std::size_t n = 0; n < triangles_.size(); n += 8000) made.cut(n, {1, 1e-3, 1e-3});
        return made;
    }

    double area() const {
        double sum = 0;
        for (const Corners& t : triangles_) sum += area_of(t);
        return sum;
    }
    /// The quotient of the largest and the smallest area of a triangle.
    double spread() const {
        double least = 1e300, most = 0;
        for (const Corners& t : triangles_) {
            least = std::min(least, area_of(t));
            most = std::max(most, area_of(t));
        }
        return most / least;
    }
    std::string obj() const {
        std::string text;
        for (const Vector3d& p : points_) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
        for (const Corners& t : triangles_)
            text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
        return text;
    }

private:
    using Corners = std::array<std::uint32_t, 3>;

    double area_of(const Corners& t) const {
        return length(cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]])) / 2;
    }

    void cut(std::size_t n, const std::array<double, 3>& parts) {
        const Corners t = triangles_[n];
        const double sum = parts[0] + parts[1] + parts[2];
        Vector3d inside;
        for (std::size_t k = 0; k < 3; ++k) inside = inside + points_[t[k]] * (parts[k] / sum);
        const auto point = static_cast<std::uint32_t>(points_.size());
        points_.push_back(inside);
        triangles_[n] = {t[0], t[1], point};
        triangles_.push_back({t[1], t[2], point});
        triangles_.push_back({t[2], t[0], point});
    }

    std::vector<Vector3d> points_;
    std::vector<Corners> triangles_;
};

}  // namespace cascade::test
