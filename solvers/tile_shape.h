// The shape of a tile in time. It says when each layer of an axis is computed if several levels
// (successive passes of steps) run while the layers are in the cache.
//
// A level reads layers at most one layer away and writes its own layer. An axis is cut into bands.
// In the *upright* part of a band, each level computes one layer fewer at each end that is a
// border. The *inverted* part around a border is the rest, which widens from level to level.
//
//     level 3      / inverted \      upright      / inverted \      |
//           2     /            \                 /            \     | time
//           1    /              \               /              \    |
//           0   '                '-------------'                '   |
//               border 0          band 1         border 1
//
// Several threads compute first all upright parts, then all inverted ones. Within a part, level l
// computes layer p − l at moment p, so a layer is in use for as many moments as there are levels.
// The layers of other levels at most one layer away are then computed in an earlier phase or
// earlier in the same part. Planes may therefore be overwritten in the same way as if each level
// computed the whole axis.
//
// Such shapes are known as split tiling, and wavefronts through them as time skewing (R. Strzodka,
// M. Shaheen, D. Pajak, H.-P. Seidel, "Cache accurate time skewing in iterative stencil
// computations", ICPP 2011; T. Grosser et al., "Split tiling for GPUs: automatic parallelization
// using trapezoidal tiles", GPGPU-6, 2013).
#pragma once

#include <cstdint>

namespace cascade {

/// A half-open range of layers. If the axis wraps, the range may begin before layer 0 or end after
/// the last layer: of n layers, layer n is layer 0.
struct LayerRange {
    std::int64_t begin = 0, end = 0;
    bool empty() const { return begin >= end; }
};

class TileAxis {
public:
    /// Cuts `layers` layers into at least one band and at most one per layer. `wraps` says that the
    /// last layer and the first are neighbours.
    TileAxis(std::int64_t layers, int bands, bool wraps);

    std::int64_t layers() const { return layers_; }
    int bands() const { return bands_; }
    bool wraps() const { return wraps_; }
    int borders() const { return wraps_ ? bands_ : bands_ - 1; }
    /// The largest number of levels with which the parts around two borders do not touch. At
    /// least 1.
    int most_levels() const;

    /// The layers of a band that are computed at `level`, which is 0 … most_levels() − 1.
    LayerRange upright(int band, int level) const;
    /// The layers that the level computes around the border after band `border`.
    LayerRange inverted(int border, int level) const;
    /// The number of a layer of a range, wrapped into the axis.
    std::int64_t wrapped(std::int64_t layer) const {
        return layer < 0 ? layer + layers_ : layer < layers_ ? layer : layer - layers_;
    }

private:
    std::int64_t begin_of(int band) const;

    std::int64_t layers_;
    int bands_;
    bool wraps_;
};

}  // namespace cascade
