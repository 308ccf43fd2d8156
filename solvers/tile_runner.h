// Runs several levels (passes of steps) while the values that they read are in the cache, in tiles
// of the shapes of solvers/tile_shape.h. A team of threads shares the tiles.
//
// A grid is cut along its rows. A grid with slices is cut along its slices and, within each slice,
// along its rows. A grid with few slices is cut along its rows alone, and a layer is the same rows
// of all slices. A grid with few rows in total is cut along its columns. In a part of a grid,
// layers include the rows of the halo, and each level leaves out the rows that it does not compute.
// With two axes, a tile is a part of one axis times a part of the other, and there are four phases.
// A cell's phase along each axis never decreases from level to level, so the values that the cell
// reads are complete. Two of the four phases are upright along one axis and inverted along the
// other. The tiles of these two phases do not depend on each other.
//
// Kernels write beyond the last column of a row. If columns wrap, the cells there are copies of the
// first column, so the first and the last column must belong to one layer. Therefore layer 0 also
// has the columns that are left over when all layers have the same width. If columns do not wrap,
// the last layer has the columns left over.
#pragma once

#include "core/parallel.h"
#include "solvers/pass_runner.h"
#include "solvers/tile_shape.h"
#include "solvers/tiling.h"

#include <array>
#include <cstdint>

namespace cascade {

class TileRunner {
public:
    static constexpr int most_levels = 64;

    /// `threads` threads share the tiles. If bands are too narrow, uses fewer levels than the
    /// tiling has. `runner` must outlive the object.
    TileRunner(const PassRunner& runner, const Tiling& tiling, int threads);

    /// The number of levels in a tile. It is 1 if tiles would save no time.
    int levels() const { return levels_; }
    bool is_along_columns() const { return tiling_.along == Tiling::Along::columns; }
    /// The number of phases of a tile. Phases run one after the other. Between two phases, threads
    /// wait for each other.
    int phases() const { return (outer_.borders() > 0 ? 2 : 1) * (inner_.borders() > 0 ? 2 : 1); }

    /// Runs levels 0 … `levels` − 1 of all workers, which must have bound the same levels. All
    /// threads of the team in use call it. After the next barrier of the team, the results are
    /// visible to every thread.
    void run(PassRunner::Worker& worker, Team& team, int levels) const;

private:
    /// The ranges of layers that each level computes in a part of an axis.
    using Part = std::array<LayerRange, most_levels>;

    static int parts(const TileAxis& axis, bool inverted) {
        return inverted ? axis.borders() : axis.bands();
    }
    static void set_part(const TileAxis& axis, bool inverted, int number, int levels, Part& part);
    void run_wave(PassRunner::Worker& worker, const Part& outer, const Part& inner,
                  int levels) const;
    void run_layer(PassRunner::Worker& worker, int level, std::int64_t layer,
                   LayerRange inner) const;
    void run_columns(PassRunner::Worker& worker, int level, LayerRange layers) const;

    const PassRunner& runner_;
    Tiling tiling_;
    TileAxis outer_, inner_;
    int levels_ = 1;
};

}  // namespace cascade
