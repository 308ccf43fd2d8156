// Runs the phases of a tile one by one. Within a part, a wavefront runs over layers and levels.
#include "solvers/tile_runner.h"

#include "core/check.h"

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

std::int64_t layers_of(std::int64_t count, std::int64_t each) { return (count + each - 1) / each; }

/// Whether a layer consists of whole slices or, in a grid of one slice, of whole rows.
bool is_of_slices(const Grid& grid, const Tiling& tiling) {
    return grid.depth > 1 && tiling.along == Tiling::Along::slices;
}

/// The rows of which layers of the outer axis consist, or the slices if layers are whole slices.
/// Not for layers of columns.
RowRange outer_range(const PassRunner& runner, const Tiling& tiling) {
    const PlaneLayout& layout = runner.layout();
    if (layout.depth == 1) return layout.rows;
    if (!is_of_slices(runner.problem().grid, tiling)) return {0, layout.height};
    return {layout.rows.begin / layout.height, layout.rows.end / layout.height};
}

TileAxis outer_axis(const PassRunner& runner, const Tiling& tiling, int threads) {
    const StepProblem& problem = runner.problem();
    const Grid& grid = problem.grid;
    if (tiling.along == Tiling::Along::columns) {
        CHECK(!grid.linked && tiling.outer_layer % PlaneLayout::row_pad == 0,
              "layers of columns are as kernels need them");
        return {std::max<std::int64_t>(grid.width / tiling.outer_layer, 1), threads,
                wraps(problem, Side::left)};
    }
    // A part has halos at the ends of its axis, and itself computes the layers of these halos.
    const bool is_divided = runner.is_part() && (grid.depth == 1 || is_of_slices(grid, tiling));
    const Side side = is_of_slices(grid, tiling) ? Side::front : Side::top;
    return {layers_of(outer_range(runner, tiling).count(), tiling.outer_layer), threads,
            !grid.linked && !is_divided && wraps(problem, side)};
}

/// The axis along which slices are cut into bands. Counts as one layer if slices are not cut.
TileAxis inner_axis(const StepProblem& problem, const Tiling& tiling) {
    if (!is_of_slices(problem.grid, tiling) || tiling.inner_bands <= 1) return {1, 1, false};
    return {layers_of(problem.grid.height, tiling.inner_layer), tiling.inner_bands,
            wraps(problem, Side::top)};
}

}  // namespace

TileRunner::TileRunner(const PassRunner& runner, const Tiling& tiling, int threads)
    : runner_(runner),
      tiling_(tiling),
      outer_(outer_axis(runner, tiling, threads)),
      inner_(inner_axis(runner.problem(), tiling)),
      levels_(std::clamp(std::min({tiling.levels, outer_.most_levels(), inner_.most_levels()}), 1,
                         most_levels)) {}

void TileRunner::run(PassRunner::Worker& worker, Team& team, int levels) const {
    if (levels == 1 && is_along_columns()) {
        // Each thread computes one band of columns. There may be fewer bands than threads.
        if (worker.number < outer_.bands())
            run_columns(worker, 0, outer_.upright(worker.number, 0));
        return;
    }
    Part outer, inner;
    bool is_first = true;
    for (const bool outer_inverted : {false, true}) {
        for (const bool inner_inverted : {false, true}) {
            const int inner_parts = parts(inner_, inner_inverted);
            const int tiles = parts(outer_, outer_inverted) * inner_parts;
            if (tiles == 0) continue;
            if (!is_first) team.barrier();
            is_first = false;
            const RowRange mine = split_rows(tiles, worker.number, worker.count);
            for (auto tile = static_cast<int>(mine.begin); tile < mine.end; ++tile) {
                set_part(outer_, outer_inverted, tile / inner_parts, levels, outer);
                set_part(inner_, inner_inverted, tile % inner_parts, levels, inner);
                run_wave(worker, outer, inner, levels);
            }
        }
    }
}

void TileRunner::set_part(const TileAxis& axis, bool inverted, int number, int levels, Part& part) {
    for (int level = 0; level < levels; ++level) {
        part[static_cast<std::size_t>(level)] =
            inverted ? axis.inverted(number, level) : axis.upright(number, level);
    }
}

void TileRunner::run_wave(PassRunner::Worker& worker, const Part& outer, const Part& inner,
                          int levels) const {
    std::int64_t begin = std::numeric_limits<std::int64_t>::max(), end = 0;
    for (int level = 0; level < levels; ++level) {
        const LayerRange layers = outer[static_cast<std::size_t>(level)];
        if (layers.empty()) continue;
        begin = std::min(begin, layers.begin + level);
        end = std::max(end, layers.end + level);
    }
    for (std::int64_t moment = begin; moment < end; ++moment) {
        for (int level = 0; level < levels; ++level) {
            const LayerRange layers = outer[static_cast<std::size_t>(level)];
            const std::int64_t layer = moment - level;
            if (layer < layers.begin || layer >= layers.end) continue;
            run_layer(worker, level, outer_.wrapped(layer), inner[static_cast<std::size_t>(level)]);
        }
    }
}

void TileRunner::run_layer(PassRunner::Worker& worker, int level, std::int64_t layer,
                           LayerRange inner) const {
    if (is_along_columns()) return run_columns(worker, level, {layer, layer + 1});
    const PlaneLayout& layout = runner_.layout();
    const auto run = [&](std::int64_t begin, std::int64_t end) {
        if (begin < end) runner_.run_cells(worker, static_cast<std::size_t>(level), {{begin, end}});
    };
    const RowRange axis = outer_range(runner_, tiling_);
    const std::int64_t first = axis.begin + layer * tiling_.outer_layer;
    const std::int64_t last = std::min(first + tiling_.outer_layer, axis.end);
    if (layout.depth == 1) return run(first, last);
    if (!is_of_slices(runner_.problem().grid, tiling_)) {
        for (std::int64_t row = layout.rows.begin; row < layout.rows.end; row += layout.height) {
            run(row + first, row + last);
        }
        return;
    }
    if (inner_.layers() == 1) return run(first * layout.height, last * layout.height);
    const auto rows_of = [&](std::int64_t slice, std::int64_t begin, std::int64_t end) {
        const std::int64_t start = slice * layout.height;
        run(start + begin * tiling_.inner_layer,
            start + std::min(end * tiling_.inner_layer, layout.height));
    };
    for (std::int64_t slice = first; slice < last; ++slice) {
        // A layer beyond one end of the axis is the layer at the other end.
        rows_of(slice, std::max<std::int64_t>(inner.begin, 0),
                std::min(inner.end, inner_.layers()));
        if (inner.begin < 0) rows_of(slice, inner.begin + inner_.layers(), inner_.layers());
        if (inner.end > inner_.layers()) rows_of(slice, 0, inner.end - inner_.layers());
    }
}

void TileRunner::run_columns(PassRunner::Worker& worker, int level, LayerRange layers) const {
    const PlaneLayout& layout = runner_.layout();
    const auto run = [&](std::int64_t begin, std::int64_t end) {
        runner_.run_cells(worker, static_cast<std::size_t>(level), {layout.rows, {begin, end}});
    };
    if (layers.begin == 0 && layers.end == outer_.layers()) return run(0, layout.width);
    const std::int64_t columns = tiling_.outer_layer, left_over = outer_.layers() * columns;
    const std::int64_t begin = layers.begin * columns, end = layers.end * columns;
    if (outer_.wraps() && layers.begin == 0 && left_over < layout.width)
        run(left_over, layout.width);
    const bool is_last = layers.end == outer_.layers() && !outer_.wraps();
    run(begin, is_last ? layout.width : std::min(end, layout.width));
}

}  // namespace cascade
