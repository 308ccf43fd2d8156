// Transforms planes into waves and back (internal to solvers/).
//
// Waves are eigenvectors of the discrete Laplacian on a grid whose sides are periodic or have a
// given flux or value. They are sines and cosines along each axis, whose phase depends on the
// sides. The change of a species obeys the same rules at the sides, with the value 0. FFTW
// transforms one axis after the other.
#pragma once

#include "core/parallel.h"
#include "core/side.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// Some waves of one species, in a buffer: lines of `count` waves, one after the other. A wave is a
/// number or, if rows are periodic, a complex number of two elements.
template <typename Number>
struct WaveBlock {
    std::size_t species = 0;
    /// The offset of this block in a plane: the number of elements from cell (0, 0, 0) to the first
    /// element in which numbers of the block are stored.
    std::int64_t offset = 0;
    std::int64_t lines = 0, count = 0;
    bool is_complex = false;
    std::uint8_t axis = 0;  ///< The lines run along x (0), y (1) or z (2).
    /// The factors by which the second differences along x, y and z multiply a wave. Along `axis`
    /// there is one factor per wave, along x (if it is not `axis`) one per line, and along any
    /// other axis one for the block.
    const Number* differences[3] = {};
    /// The factors by which the central differences along periodic x and y multiply a wave, divided
    /// by i. The negated product of the two is the factor of dxy.
    const Number* slopes[2] = {};
    double gain = 1;  ///< The factor by which values grow in a transform followed by its inverse.
    std::span<Number* const> waves;  ///< The transformed waves, then room for other waves.

    /// The number of columns of elements that share a block.
    static constexpr std::int64_t columns = 16;
};

template <typename Number>
class WaveTransforms {
public:
    /// `sides` has the rules of each species. Throws std::bad_alloc.
    WaveTransforms(const Grid& grid, const std::vector<SideRules>& sides);
    WaveTransforms(WaveTransforms&&) noexcept;
    ~WaveTransforms();

    using Visit = std::function<void(const WaveBlock<Number>& block)>;
    /// Transforms the planes of to[0] into waves. Calls `visit`, which changes blocks of waves.
    /// Then transforms waves[k] of each block back into the planes of to[k], for each k. Planes are
    /// given by the addresses of their cells (0, 0, 0), one per species. A species that is not
    /// `transformed` is visited row by row.
    ///
    /// The first `threads` threads of the team call this, each with its number and otherwise the
    /// same arguments. Each thread reads the rows that split_rows() gives it before the first
    /// barrier of the team, and writes them after the last. The result is the same bit for bit with
    /// any number of threads. The work is abandoned when `cancel`, which may be null, becomes true.
    void apply(Team& team, int thread, int threads, const std::vector<bool>& transformed,
               std::span<const std::span<Number* const>> to, const Visit& visit,
               const std::atomic<bool>* cancel = nullptr) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

extern template class WaveTransforms<float>;
extern template class WaveTransforms<double>;

}  // namespace cascade
