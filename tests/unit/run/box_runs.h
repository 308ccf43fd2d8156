// Compares a run inside a box-shaped mask with the run on a grid of the box's size.
#pragma once

#include "mask_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade::test {

/// A system with these rates, which may use p, q and r, the cell's numbers from a corner of the
/// box. All starting values differ from cell to cell, so that reading a wrong neighbour changes the
/// result.
inline std::string system_of(const std::string& rates) {
    return "system s {\n"
           "  p: P; q: Q; r: R\n"
           "  u: sin(1.3 * p + 0.7 * q - 0.9 * r) + 0.1 * p\n"
           "  v: cos(0.8 * p - 1.1 * q + 0.3 * r) - 0.05 * q\n"
           "  k: 1 + 0.3 * sin(p + 2 * q)\n"
           "  a: 0.3 * p - q\n" +
           rates + "}\n";
}

struct Operator {
    const char* name;
    const char* rates;
};

inline const Operator operators_of_planes[] = {
    {"lap of a species", "u' = lap(u)\nv' = lap(v)\n"},
    {"lap of an expression", "u' = lap(u * v + k)\nv' = lap(sin(v))\n"},
    {"nested", "w = u^3 - u - 0.5 * lap(u)\nu' = lap(w)\nv' = lap(lap(k * v))\n"},
    {"first derivatives", "u' = dx(v) + 2 * dy(u * k)\nv' = grad2(u + v)\n"},
    {"second derivatives", "u' = dxx(u) - dyy(v)\nv' = dxy(u) + dxy(u * k)\n"},
    {"advect", "u' = -advect(v, k - 1, u)\nv' = -advect(u, v, k * v)\n"},
    {"diffuse", "u' = diffuse(u, 1, 0.3, a)\nv' = diffuse(u * v, 0.4, 0.9, 0.5)\n"},
    {"flux", "u' = div(k * grad(u)) - div(v * u * grad(v))\nv' = div(grad(lap(v)) / k)\n"},
    {"flux of a vector", "u' = div(vector(u * v, k))\nv' = div(v * vector(1, -2))\n"},
    {"tensor",
     "u' = div(tensor(1, 0.2, a) * grad(u))\nv' = div(tensor(k, 0.5, 1) * grad(u * v))\n"},
};

/// Compares the cells of a large grid inside a box with a small grid of the box's size, cell by
/// cell. Rates may end with rules for u.WALL and the like, where WALL becomes the border of the
/// box's mask or the sides of the small grid.
inline void expect_box_is_grid(const std::string& rates, const std::string& stage, GridSize large,
                               GridSize small, GridSize corner, const std::string& what) {
    const auto with_walls = [](std::string text, std::string_view name) {
        for (auto at = text.find("WALL"); at != std::string::npos; at = text.find("WALL"))
            text.replace(at, 4, name);
        return text;
    };
    const auto script = [&](GridSize size, GridSize from, const std::string& domain) {
        const std::int64_t longest = std::max({size.width, size.height, size.depth});
        std::string text =
            fmt::format("domain {{ grid: {}, {}, {}; {} }}\n{}stage only: s {{ {} }}\n", size.width,
                        size.height, size.depth, domain, system_of(rates), stage);
        const auto count = [&](const char* name, const char* axis, std::int64_t first) {
            const std::string key = fmt::format("{}: {}", name, static_cast<char>(name[0] - 32));
            text.replace(text.find(key), key.size(),
                         fmt::format("{}: floor({} * {}) - {}", name, longest, axis, first));
        };
        count("p", "x", from.width);
        count("q", "y", from.height);
        count("r", "z", from.depth);
        return text;
    };
    const auto between = [&](const char* axis, std::int64_t first, std::int64_t count) {
        const std::int64_t longest = std::max({large.width, large.height, large.depth});
        return fmt::format("{0} > {1}/{3} and {0} < {2}/{3}", axis, first, first + count, longest);
    };
    const std::string box =
        fmt::format("mask: {} and {} and {}", between("x", corner.width, small.width),
                    between("y", corner.height, small.height),
                    between("z", corner.depth, small.depth));
    const auto masked = finished_script(with_walls(script(large, corner, box), "border"));
    const auto plain =
        finished_script(with_walls(script(small, {0, 0, 0}, "boundary: noflux"), "sides"));
    ASSERT_EQ(masked->failure, "") << what;
    ASSERT_EQ(plain->failure, "") << what;
    for (const std::string name : {"u", "v"}) {
        const Field& found = masked->field(name);
        const Field& expected = plain->field(name);
        int wrong = 0;
        for (std::int64_t k = 0; k < large.depth; ++k) {
            for (std::int64_t j = 0; j < large.height; ++j) {
                for (std::int64_t i = 0; i < large.width; ++i) {
                    const std::int64_t x = i - corner.width, y = j - corner.height,
                                       z = k - corner.depth;
                    const bool is_inside = x >= 0 && x < small.width && y >= 0 &&
                                           y < small.height && z >= 0 && z < small.depth;
                    const float right = is_inside ? expected.at(x, y, z) : 0.0F;
                    if (word(found.at(i, j, k)) != word(right)) ++wrong;
                }
            }
        }
        EXPECT_EQ(wrong, 0) << what << ", " << name;
    }
}

}  // namespace cascade::test
