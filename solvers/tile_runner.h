// Runs several levels (passes of steps) while what they read is in the cache: tiles in the shapes
// of solvers/tile_shape.h, shared by a team of threads.
//
// A grid is cut along its rows, a grid with slices along its slices and, within each, its rows; or
// along its rows alone, which are then those of all slices, where slices are few. With two axes a
// tile is a part of the one times a part of the other, and there are four phases: a cell's phase
// along each axis never decreases from level to level, so what it reads is done before it. Tiles of
// the two phases that are upright along one axis and inverted along the other do not depend on each
// other.
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

    /// So many `threads` share the tiles. Fewer levels than the tiling asks for are used where
    /// bands are too narrow for them. `runner` must outlive it.
    TileRunner(const PassRunner& runner, const Tiling& tiling, int threads);

    /// Levels of a tile; 1 where tiles are of no use.
    int levels() const { return levels_; }
    /// Parts of a tile that are run one after the other; threads meet between them.
    int phases() const { return (outer_.borders() > 0 ? 2 : 1) * (inner_.borders() > 0 ? 2 : 1); }

    /// Runs levels 0 … `levels` − 1 of all workers, which all of them have bound alike. All threads
    /// of the team in use call it. When it returns, another meeting of the team makes what was
    /// written visible to every thread.
    void run(PassRunner::Worker& worker, Team& team, int levels) const;

private:
    /// A part of an axis: what each level does of it.
    using Part = std::array<LayerRange, most_levels>;

    static int parts(const TileAxis& axis, bool inverted) {
        return inverted ? axis.borders() : axis.bands();
    }
    static void set_part(const TileAxis& axis, bool inverted, int number, int levels, Part& part);
    void run_wave(PassRunner::Worker& worker, const Part& outer, const Part& inner,
                  int levels) const;
    void run_layer(PassRunner::Worker& worker, int level, std::int64_t layer,
                   LayerRange inner) const;

    const PassRunner& runner_;
    Tiling tiling_;
    TileAxis outer_, inner_;
    int levels_ = 1;
};

}  // namespace cascade
