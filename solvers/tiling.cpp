// Counts the bytes that a step touches and fits layers into a part of the second- or third-level
// cache. The constants are measured (docs/time_tiling.md).
#include "solvers/tiling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace cascade {
namespace {

// A layer has at least this many cells, including halo. A kernel call for fewer cells costs more
// time than the second-level cache saves. In a grid 512 cells wide, a layer has three rows. In a
// grid 1024 cells wide it has one row: layers of two rows are 7 % slower, because the levels fill
// more of the cache.
constexpr std::int64_t cells_of_a_layer = 1632;
// cells_of_a_layer was measured with kernels of at most this many results. With more results, a
// kernel call for fewer cells is as much work.
constexpr std::size_t few_results = 8;
// The fraction of a cache that the levels of a tile share. The rest of the cache is for data that
// the levels use only once.
constexpr double part_of_second = 0.6, part_of_third = 0.5;
// Each level uses one layer. This many more layers are in use: the neighbouring layers that a level
// reads.
constexpr std::int64_t layers_besides = 3;
// More levels than this hardly save anything.
constexpr int enough_levels = 16;
// Slices are cut into bands of rows only if whole slices would allow fewer levels than this.
constexpr int few_levels = 6;
constexpr int levels_in_bands = 8;
// In a grid with fewer rows than this, threads and tiles divide the columns among themselves, not
// the rows. In a tile of rows, each level is a layer shorter at both ends than the level before, so
// the later levels would be empty.
constexpr std::int64_t few_rows = 2 * enough_levels;
// The least width of layers of columns. In narrower layers, starting the loop over a row costs too
// much time.
constexpr std::int64_t least_columns = 64;

/// The bytes that the layers of a tile may take.
double bytes_for_layers(const CacheSizes& caches) {
    return std::max(part_of_second * static_cast<double>(caches.second),
                    part_of_third * static_cast<double>(caches.third));
}

/// The number of levels that fit into `bytes` if a layer takes `layer_bytes`.
int levels_in(double bytes, std::int64_t layer_bytes) {
    const auto layers = static_cast<std::int64_t>(bytes) / std::max<std::int64_t>(layer_bytes, 1);
    return static_cast<int>(std::clamp<std::int64_t>(layers - layers_besides, 1, enough_levels));
}

/// Whether a level finds its data in the second-level cache: the values that the previous level has
/// just written, and the older values that the level overwrites.
bool is_near(std::int64_t layer_bytes, const CacheSizes& caches) {
    return (1 + layers_besides) * layer_bytes <= caches.second;
}

/// The number of rows or slices in a layer. The grid has `count` rows or slices of `cells_of_each`
/// cells.
std::int64_t height_of_layer(const StepProblem& problem, std::int64_t cells_of_each,
                             std::int64_t count) {
    std::size_t results = few_results;
    for (const auto& pass : problem.passes) results = std::max(results, pass.results.size());
    const auto cells = cells_of_a_layer * few_results / results;
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(cells) / cells_of_each, 1, count);
}

/// The tiling with layers of `height` rows or slices. All `count` rows or slices together take
/// `bytes`.
Tiling tiling_of_layers(std::int64_t height, std::int64_t count, std::int64_t bytes,
                        const CacheSizes& caches) {
    Tiling tiling;
    if (height >= count)
        return tiling;  // Levels that consist of a single layer have nothing to overlap.
    tiling.outer_layer = height;
    const std::int64_t layer_bytes = bytes / count * height;
    tiling.levels = levels_in(bytes_for_layers(caches), layer_bytes);
    tiling.is_near = is_near(layer_bytes, caches);
    return tiling;
}

/// The number of columns in a layer of columns.
std::int64_t columns_of_a_layer(const Grid& grid) {
    const std::int64_t columns =
        std::max(cells_of_a_layer / (grid.height * grid.depth), least_columns);
    return columns / PlaneLayout::row_pad * PlaneLayout::row_pad;
}

/// The tiling of a grid with slices. Layers are whole slices or, with few slices, the same rows of
/// all slices. If neither fits, slices are cut into bands of rows.
Tiling tiling_of_slices(const StepProblem& problem, const Grid& grid, std::int64_t bytes,
                        const CacheSizes& caches) {
    const std::int64_t stride = PlaneLayout(grid).stride;
    const std::int64_t slices = height_of_layer(problem, stride * grid.height, grid.depth);
    const std::int64_t rows = height_of_layer(problem, stride * grid.depth, grid.height);
    const Tiling of_slices = tiling_of_layers(slices, grid.depth, bytes, caches);
    // If an axis wraps, each level is a layer shorter at both ends of the axis.
    const bool is_flat = grid.depth / slices < 2 * enough_levels;
    if (of_slices.levels >= few_levels && !is_flat) return of_slices;
    Tiling of_rows = tiling_of_layers(rows, grid.height, bytes, caches);
    of_rows.along = Tiling::Along::rows;
    if (of_rows.levels >= few_levels && grid.height > grid.depth) return of_rows;
    if (of_slices.levels >= few_levels) return of_slices;
    const double band_bytes = bytes_for_layers(caches) / (levels_in_bands + layers_besides);
    const double bands = std::ceil(static_cast<double>(bytes / grid.depth * slices) / band_bytes);
    // A band must be wider than its two borders, each of which has a row per level.
    if (bands * 2 * levels_in_bands > static_cast<double>(grid.height)) return of_slices;
    Tiling in_bands = of_slices;
    in_bands.levels = levels_in_bands;
    in_bands.inner_bands = static_cast<int>(bands);
    return in_bands;
}

/// Whether the values at any side vary both along the rows and with time. Such values are computed
/// for whole rows.
bool has_changing_rows(const StepProblem& problem) {
    return std::any_of(problem.changing_sides.begin(), problem.changing_sides.end(),
                       [](const ChangingSide& side) {
                           return side.varies && side.side != Side::left &&
                                  side.side != Side::right;
                       });
}

/// The tiling with one level, which runs each pass separately.
Tiling plain_tiling(const StepProblem& problem, const Grid& grid) {
    Tiling plain;
    if (!has_few_rows(grid) || has_changing_rows(problem)) return plain;
    plain.along = Tiling::Along::columns;
    plain.outer_layer = columns_of_a_layer(grid);
    return plain;
}

/// The share of bytes_of_step() that belongs to `grid`, some rows or slices of the problem's grid.
std::int64_t bytes_of_rows(const StepProblem& problem, const Grid& grid) {
    const auto part =
        static_cast<double>(grid.cell_count()) / static_cast<double>(problem.grid.cell_count());
    return static_cast<std::int64_t>(part * static_cast<double>(bytes_of_step(problem)));
}

/// The tiling of planes that are too large for the caches and mostly come from memory in every
/// step. `grid` has the rows or slices to be tiled.
Tiling tiling_beyond_cache(const StepProblem& problem, const Grid& grid, std::int64_t reach,
                           const CacheSizes& caches) {
    const Tiling plain = plain_tiling(problem, grid);
    if (std::all_of(problem.passes.begin(), problem.passes.end(), needs_all_rows)) return plain;
    const std::int64_t bytes = bytes_of_rows(problem, grid);
    std::int64_t rows = height_of_layer(problem, PlaneLayout(grid).stride, grid.height);
    if (grid.linked) rows = std::max(rows, reach);
    const Tiling of_rows = grid.depth > 1 ? tiling_of_slices(problem, grid, bytes, caches)
                                          : tiling_of_layers(rows, grid.height, bytes, caches);
    if (grid.linked || has_changing_rows(problem)) return of_rows;
    const std::int64_t columns = columns_of_a_layer(grid);
    const std::int64_t bytes_of_levels =
        bytes / grid.width * columns * (enough_levels + layers_besides);
    if (!has_few_rows(grid) && (of_rows.is_near || bytes_of_levels > caches.second)) return of_rows;
    Tiling of_columns = tiling_of_layers(columns, grid.width, bytes, caches);
    if (of_columns.levels == 1) return plain;
    of_columns.along = Tiling::Along::columns;
    return of_columns;
}

/// The least number of values per thread and step. With fewer values, a barrier costs more than a
/// thread saves: computing so many values takes about 10 µs, and a barrier about 1 µs. Values of
/// cells with links take longer.
constexpr std::int64_t least_values_per_thread = 16384;
constexpr std::int64_t least_linked_values_per_thread = 8192;

}  // namespace

bool has_few_rows(const Grid& grid) {
    return !grid.linked && grid.height * grid.depth < few_rows && grid.width >= least_columns;
}

Patch share_of(const Grid& grid, int index, int count) {
    const std::int64_t rows = grid.height * grid.depth;
    if (!has_few_rows(grid)) return {split_rows(rows, index, count)};
    const RowRange columns = split_rows(grid.width, index, count);
    return {{0, rows}, {columns.begin, columns.end}};
}

int worthwhile_threads(const Grid& grid, std::size_t species, int most) {
    const std::int64_t values = grid.cell_count() * static_cast<std::int64_t>(species);
    const std::int64_t least =
        grid.linked ? least_linked_values_per_thread : least_values_per_thread;
    const std::int64_t parts =
        has_few_rows(grid) ? grid.width / PlaneLayout::row_pad : grid.height * grid.depth;
    const std::int64_t worth = std::min(values / least, parts);
    return static_cast<int>(std::clamp<std::int64_t>(worth, 1, std::max(most, 1)));
}

bool needs_all_rows(const StepProblem::Pass& pass) {
    return !pass.reductions.empty() || !pass.convolutions.empty() || !pass.solves.empty() ||
           pass.filter;
}

std::int64_t bytes_of_step(const StepProblem& problem) {
    std::set<StepProblem::PlaneRef> planes;
    std::set<const Mask*> masks;
    for (const StepProblem::Pass& pass : problem.passes) {
        planes.insert(pass.fields.begin(), pass.fields.end());
        for (const StepProblem::Result& result : pass.results) {
            planes.insert(result.plane);
            // The same plane may be written as the new step and read as the old step. It is counted
            // once.
            const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&result.plane);
            if (own != nullptr && own->in_register == new_register) {
                planes.insert(StepProblem::SpeciesPlane{own->species, old_register});
            }
        }
        masks.insert(pass.masks.begin(), pass.masks.end());
    }
    const std::int64_t cells =
        PlaneLayout(problem.grid).stride * problem.grid.height * problem.grid.depth;
    return cells * (static_cast<std::int64_t>(planes.size() * bytes_of(problem.precision)) +
                    static_cast<std::int64_t>(masks.size())) +
           (problem.links ? static_cast<std::int64_t>(problem.links->bytes()) : 0);
}

std::int64_t rows_reached(const StepProblem& problem) {
    if (!problem.links) return 1;
    return with_number(problem.precision, [&](auto zero) {
        return problem.links->template table<decltype(zero)>().reach;
    });
}

bool wraps(const StepProblem& problem, Side side) {
    const auto is_periodic = [&](const SideRules& rules) {
        return rules[side].kind == SideKind::periodic ||
               rules[opposite(side)].kind == SideKind::periodic;
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
    return choose_tiling(problem, problem.grid, reach, caches);
}

Tiling choose_tiling(const StepProblem& problem, const Grid& grid, std::int64_t reach,
                     const CacheSizes& caches) {
    const bool is_small =
        static_cast<double>(bytes_of_rows(problem, grid)) <= bytes_for_layers(caches);
    return is_small ? plain_tiling(problem, grid)
                    : tiling_beyond_cache(problem, grid, reach, caches);
}

std::vector<Tiling> tilings_to_try(const StepProblem& problem, std::int64_t reach,
                                   const CacheSizes& caches, int threads) {
    std::vector<Tiling> tilings = {choose_tiling(problem, reach, caches)};
    const Tiling tiled = tiling_beyond_cache(problem, problem.grid, reach, caches);
    const bool is_small = static_cast<double>(bytes_of_step(problem)) / threads <=
                          part_of_second * static_cast<double>(caches.second);
    if (tiled.levels == 1 || is_small) return tilings;
    const auto add = [&](const Tiling& other) {
        if (std::find(tilings.begin(), tilings.end(), other) == tilings.end())
            tilings.push_back(other);
    };
    add(tiled);
    Tiling fewer = tiled;
    fewer.levels = std::max(2, tiled.levels / 2);
    add(fewer);
    const double layer = bytes_in_use(problem, tiled, 1) / (1 + layers_besides);
    fewer.levels = std::clamp(levels_in(part_of_second * static_cast<double>(caches.second),
                                        static_cast<std::int64_t>(layer)),
                              2, fewer.levels);
    add(fewer);
    add(plain_tiling(problem, problem.grid));
    return tilings;
}

bool stays_in_cache(const StepProblem& problem, const CacheSizes& caches) {
    return static_cast<double>(bytes_of_step(problem)) <= bytes_for_layers(caches);
}

double bytes_in_use(const StepProblem& problem, const Tiling& tiling, int levels) {
    const Grid& grid = problem.grid;
    const bool along_slices = grid.depth > 1 && tiling.along == Tiling::Along::slices;
    const std::int64_t length = tiling.along == Tiling::Along::columns ? grid.width
                                : along_slices                         ? grid.depth
                                                                       : grid.height;
    const auto layers = static_cast<double>(length) / static_cast<double>(tiling.outer_layer);
    return static_cast<double>(bytes_of_step(problem)) / layers / tiling.inner_bands *
           static_cast<double>(levels + layers_besides);
}

}  // namespace cascade
