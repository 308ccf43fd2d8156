// Weighted sums over the cells around each cell of a grid: discrete convolutions, directly or by
// fast Fourier transforms.
#pragma once

#include "core/grid.h"
#include "core/parallel.h"
#include "core/plane.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// The offset from one cell to another, in cells along each axis.
struct Lag {
    std::int64_t x = 0, y = 0, z = 0;
    friend bool operator==(const Lag&, const Lag&) = default;
};

/// The largest number of lags that a convolution may have.
inline constexpr std::int64_t most_lags = std::int64_t{1} << 24;

/// The number of lags in the bounding box of lags_within(). If there are more than most_lags,
/// returns some number above most_lags.
std::int64_t lags_in_box(const Grid& grid, std::optional<double> reach);

/// The lags of length at most `reach`, in order of z, y and x. `reach` has the unit of
/// Grid::spacing. Along an axis whose sides are not periodic, lags are limited to the extent of the
/// grid. Along a periodic axis, they wrap around as often as the reach requires. Without a reach, a
/// periodic axis has one lag for each of its cells: the shortest lag that leads to the cell, and
/// the positive lag if two are equally short. nullopt if there would be more than most_lags.
std::optional<std::vector<Lag>> lags_within(const Grid& grid, std::optional<double> reach);

/// A weighted sum over the cells at `lags`.
struct WeightedLags {
    std::vector<Lag> lags;
    std::vector<double> weights;  ///< One for each lag.
    friend bool operator==(const WeightedLags&, const WeightedLags&) = default;
};

/// For at most this many lags, sums are computed directly. For more lags, transforms are faster.
inline constexpr std::size_t most_direct_lags = 32;

template <typename Number>
class ConvolutionRunner {
public:
    /// Values beyond sides that are not periodic count as 0. The grid must not be linked. Throws
    /// std::bad_alloc.
    ConvolutionRunner(const Grid& grid, const WeightedLags& weighted);
    ~ConvolutionRunner();
    ConvolutionRunner(ConvolutionRunner&&) noexcept;

    /// Writes the sums for all cells of a plane into another plane. Planes are given by the
    /// addresses of their cells (0, 0, 0). The first `threads` threads of the team call this, each
    /// with its number. Begins and ends with a barrier of the team. After the last barrier, the
    /// rows of the target, but not its halo, are visible to all threads. The result is the same bit
    /// for bit with any number of threads. The work is abandoned when `cancel`, which may be null,
    /// becomes true.
    void apply(Team& team, int thread, int threads, const Number* from, Number* to,
               const std::atomic<bool>* cancel = nullptr);

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

extern template class ConvolutionRunner<float>;
extern template class ConvolutionRunner<double>;

}  // namespace cascade
