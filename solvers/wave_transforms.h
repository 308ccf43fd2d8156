// Transforms planes into waves and back (internal to solvers/).
//
// Waves are eigenvectors of the discrete Laplacian on a grid whose sides are periodic or have a
// given flux or value: sines and cosines along each axis, whose phase depends on the sides. The
// change of a species obeys the same rules at the sides with the value 0. FFTW transforms one axis
// after the other.
#pragma once

#include "core/parallel.h"
#include "core/side.h"

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
    /// Elements from cell (0, 0, 0) of a plane to the elements that store numbers for this block.
    std::int64_t offset = 0;
    std::int64_t lines = 0, count = 0;
    bool is_complex = false;
    std::uint8_t axis = 0;  ///< The lines run along x (0), y (1) or z (2).
    /// The factors by which the second differences along x, y and z multiply a wave: of each line
    /// along x, of each wave along `axis`, and otherwise the same in all of the block.
    const Number* differences[3] = {};
    /// The same for the central differences along periodic x and y, as multiples of i. The product
    /// of both is the negated factor of dxy.
    const Number* slopes[2] = {};
    double gain = 1;  ///< The factor by which the transform and its inverse together multiply.
    std::span<Number* const> waves;  ///< The transformed waves, then room for others.

    static constexpr std::int64_t columns = 16;  ///< Columns of elements that share a block.
};

template <typename Number>
class WaveTransforms {
public:
    /// `sides` are by species. Throws std::bad_alloc.
    WaveTransforms(const Grid& grid, const std::vector<SideRules>& sides);
    WaveTransforms(WaveTransforms&&) noexcept;
    ~WaveTransforms();

    using Visit = std::function<void(const WaveBlock<Number>& block)>;
    /// Transforms the planes of to[0], lets `visit` change blocks of waves, and transforms the
    /// result into the planes of each of `to`: waves[0] of a block into to[0], and so on. Planes
    /// are given by the addresses of their cells (0, 0, 0), one per species. A species that is not
    /// `transformed` is visited row by row.
    ///
    /// The first `threads` threads of the team call this, each with its number and otherwise the
    /// same arguments. Each thread reads its rows, as in split_rows(), before the first barrier of
    /// the team, and writes them after the last. Bits do not depend on `threads`.
    void apply(Team& team, int thread, int threads, const std::vector<bool>& transformed,
               std::span<const std::span<Number* const>> to, const Visit& visit) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

extern template class WaveTransforms<float>;
extern template class WaveTransforms<double>;

}  // namespace cascade
