#include "solvers/tile_runner.h"

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

std::int64_t layers_of(std::int64_t count, std::int64_t each) { return (count + each - 1) / each; }

TileAxis outer_axis(const StepProblem& problem, const Tiling& tiling, int threads) {
    const Grid& grid = problem.grid;
    const bool has_slices = grid.depth > 1;
    return {layers_of(has_slices ? grid.depth : grid.height, tiling.outer_layer), threads,
            !grid.linked && wraps(problem, has_slices ? Side::front : Side::top)};
}

/// An axis that is not cut is one layer.
TileAxis inner_axis(const PassRunner& runner, const Tiling& tiling) {
    const StepProblem& problem = runner.problem();
    const bool has_slices = problem.grid.depth > 1;
    if (tiling.inner_bands <= 1 || (!has_slices && !runner.works_on_columns())) return {1, 1, false};
    return {layers_of(has_slices ? problem.grid.height : problem.grid.width, tiling.inner_layer),
            tiling.inner_bands, wraps(problem, has_slices ? Side::top : Side::left)};
}

}  // namespace

TileRunner::TileRunner(const PassRunner& runner, const Tiling& tiling, int threads)
    : runner_(runner),
      tiling_(tiling),
      outer_(outer_axis(runner.problem(), tiling, threads)),
      inner_(inner_axis(runner, tiling)),
      levels_(std::clamp(std::min({tiling.levels, outer_.most_levels(), inner_.most_levels()}), 1,
                         most_levels)) {}

void TileRunner::run(PassRunner::Worker& worker, Team& team, int levels) const {
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

void TileRunner::run_layer(PassRunner::Worker& worker, int level_number, std::int64_t layer,
                           LayerRange inner) const {
    const PlaneLayout& layout = runner_.layout();
    const auto level = static_cast<std::size_t>(level_number);
    const bool has_slices = layout.depth > 1;
    const std::int64_t first = layer * tiling_.outer_layer;
    const std::int64_t last =
        std::min(first + tiling_.outer_layer, has_slices ? layout.depth : layout.height);
    if (inner_.layers() == 1) {
        const std::int64_t rows = has_slices ? layout.height : 1;
        return runner_.run_rows(worker, level, {first * rows, last * rows});
    }
    const std::int64_t length = has_slices ? layout.height : layout.width;
    const auto run = [&](std::int64_t begin_layer, std::int64_t end_layer) {
        const std::int64_t begin = begin_layer * tiling_.inner_layer;
        const std::int64_t end = std::min(end_layer * tiling_.inner_layer, length);
        if (begin >= end) return;
        if (!has_slices) return runner_.run_cells(worker, level, {first, last}, begin, end);
        for (std::int64_t slice = first; slice < last; ++slice) {
            const std::int64_t start = slice * layout.height;
            runner_.run_rows(worker, level, {start + begin, start + end});
        }
    };
    // What lies beyond an end of the axis is at the other end.
    run(std::max<std::int64_t>(inner.begin, 0), std::min(inner.end, inner_.layers()));
    if (inner.begin < 0) run(inner.begin + inner_.layers(), inner_.layers());
    if (inner.end > inner_.layers()) run(0, inner.end - inner_.layers());
}

}  // namespace cascade
