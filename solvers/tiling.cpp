#include "solvers/tiling.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace cascade {
namespace {

using PlaneRef = StepProblem::PlaneRef;

// A call of a kernel for fewer cells than this costs more than what it saves to keep them near.
constexpr std::int64_t cells_of_a_layer = 2048;
// So much of a cache do levels share; the rest is for what they do not touch again.
constexpr double part_of_second = 0.6, part_of_third = 0.4;
// Layers that are in use besides one for each level: those that are read around it.
constexpr std::int64_t layers_besides = 3;
// More levels hardly save anything.
constexpr int enough_levels = 16;
// With fewer the next cache is asked, for the price of its slower answers.
constexpr int few_levels = 4;

std::int64_t bytes_of_links(const Links& links) { return static_cast<std::int64_t>(links.bytes()); }

/// How many layers of so many bytes a part of a cache holds, as levels.
int levels_in(double bytes, std::int64_t layer_bytes) {
    const auto layers = static_cast<std::int64_t>(bytes) / std::max<std::int64_t>(layer_bytes, 1);
    return static_cast<int>(std::clamp<std::int64_t>(layers - layers_besides, 1, enough_levels));
}

int levels_of(std::int64_t layer_bytes, const CacheSizes& caches) {
    const int near = levels_in(part_of_second * static_cast<double>(caches.second), layer_bytes);
    if (near >= few_levels) return near;
    return std::max(near, levels_in(part_of_third * static_cast<double>(caches.third), layer_bytes));
}

/// Whole slices or bands of their rows, whichever the second-level cache holds more of.
Tiling tiling_of_slices(const Grid& grid, std::int64_t slice_bytes, const CacheSizes& caches) {
    Tiling tiling;
    tiling.outer_layer = std::clamp<std::int64_t>(
        cells_of_a_layer / std::max<std::int64_t>(grid.width * grid.height, 1), 1, grid.depth);
    const double bytes = part_of_second * static_cast<double>(caches.second);
    const std::int64_t layer_bytes = slice_bytes * tiling.outer_layer;
    tiling.levels = levels_in(bytes, layer_bytes);
    if (tiling.levels >= few_levels) return tiling;
    // Bands must be wider than what two borders take of them.
    for (int levels = 8; levels >= 2; --levels) {
        const double band_bytes = bytes / static_cast<double>(levels + layers_besides);
        const auto bands = static_cast<int>(static_cast<double>(layer_bytes) / band_bytes) + 1;
        if (grid.height / bands < 2 * levels) continue;
        tiling.levels = levels;
        tiling.inner_bands = bands;
        return tiling;
    }
    tiling.levels = levels_of(layer_bytes, caches);
    return tiling;
}

}  // namespace

std::int64_t bytes_of_step(const StepProblem& problem) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> species, temporaries;
    std::set<const void*> fixed;
    std::set<const std::uint8_t*> masks;
    const auto add = [&](const PlaneRef& ref) {
        switch (ref.kind) {
            case PlaneRef::Kind::species: species.emplace(ref.in_register, ref.number); break;
            case PlaneRef::Kind::temporary: temporaries.emplace(0, ref.number); break;
            case PlaneRef::Kind::fixed: fixed.insert(ref.cells); break;
        }
    };
    for (const StepProblem::Pass& pass : problem.passes) {
        for (const PlaneRef& ref : pass.fields) add(ref);
        for (const StepProblem::Result& result : pass.results) {
            add(result.plane);
            // What is written as the new step is read as the old one.
            if (result.plane.in_register == 1) {
                add({PlaneRef::Kind::species, result.plane.number, 0, nullptr});
            }
        }
        masks.insert(pass.masks.begin(), pass.masks.end());
    }
    const std::int64_t planes =
        static_cast<std::int64_t>(species.size() + temporaries.size() + fixed.size());
    const std::int64_t cells = PlaneLayout(problem.grid).stride * problem.grid.height *
                               problem.grid.depth;
    return cells * (planes * static_cast<std::int64_t>(bytes_of(problem.precision)) +
                    static_cast<std::int64_t>(masks.size())) +
           (problem.links ? bytes_of_links(*problem.links) : 0);
}

std::int64_t rows_reached(const StepProblem& problem) {
    if (!problem.links) return 1;
    const PlaneLayout layout(problem.grid);
    constexpr std::int64_t lanes = PlaneLayout::row_pad;
    const std::int64_t slices = (layout.width + lanes - 1) / lanes;
    return with_number(problem.precision, [&](auto zero) {
        const auto links = problem.links->template table<decltype(zero)>();
        std::int64_t reached = 1;
        for (std::int64_t row = 0; row < layout.height; ++row) {
            const std::int32_t* first = links.targets + lanes * links.starts[row * slices];
            const std::int32_t* last = links.targets + lanes * links.starts[(row + 1) * slices];
            if (first == last) continue;
            const auto [least, most] = std::minmax_element(first, last);
            reached = std::max({reached, row - *least / layout.stride, *most / layout.stride - row});
        }
        return reached;
    });
}

bool wraps(const StepProblem& problem, Side side) {
    const auto is_periodic = [&](const SideRules& rules) {
        return rules[side].kind == SideKind::periodic || rules[opposite(side)].kind == SideKind::periodic;
    };
    if (is_periodic(problem.grid.boundary)) return true;
    if (std::any_of(problem.sides.begin(), problem.sides.end(), is_periodic)) return true;
    return std::any_of(problem.passes.begin(), problem.passes.end(), [&](const auto& pass) {
        return std::any_of(pass.results.begin(), pass.results.end(), [&](const auto& result) {
            return is_periodic(problem.sides_of(result));
        });
    });
}

Tiling choose_tiling(const StepProblem& problem, std::int64_t reach, const CacheSizes& caches) {
    const Grid& grid = problem.grid;
    const std::int64_t bytes = bytes_of_step(problem);
    if (grid.depth > 1) return tiling_of_slices(grid, bytes / grid.depth, caches);
    Tiling tiling;
    tiling.outer_layer = std::clamp<std::int64_t>(
        cells_of_a_layer / std::max<std::int64_t>(grid.width, 1), 1, grid.height);
    if (grid.linked) tiling.outer_layer = std::max(tiling.outer_layer, reach);
    tiling.levels = levels_of(bytes / grid.height * tiling.outer_layer, caches);
    return tiling;
}

}  // namespace cascade
