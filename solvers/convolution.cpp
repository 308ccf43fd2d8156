// Transforms turn rows of real numbers into rows of complex waves. Columns along y and z are then
// transformed in place. On the last axis, waves are multiplied by the waves of the weights. Inverse
// transforms then turn waves into real numbers. Columns are transformed sixteen elements at a time,
// whatever the number of threads, so that results do not depend on that number. Along an axis whose
// sides are not periodic, zeros after the cells separate the two ends.
#include "solvers/convolution.h"

#include "solvers/fftw_transform.h"
#include "solvers/leave_if.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace cascade {
namespace {

/// The number of columns transformed at a time, in complex waves.
constexpr std::int64_t columns_of_block = 8;

struct Extent {
    std::int64_t cells = 1;
    bool is_periodic = false;
};

std::array<Extent, 3> extents_of(const Grid& grid) {
    return {{{grid.width, grid.boundary.x == Boundary::periodic},
             {grid.height, grid.boundary.y == Boundary::periodic},
             {grid.depth, grid.boundary.z == Boundary::periodic}}};
}

/// The smallest and the largest lag along an axis.
std::pair<std::int64_t, std::int64_t> lags_along(const Extent& axis, double spacing,
                                                 std::optional<double> reach) {
    if (axis.cells == 1) return {0, 0};
    const std::int64_t farthest = axis.cells - 1;
    if (!reach) {
        if (!axis.is_periodic) return {-farthest, farthest};
        return {-(farthest / 2), axis.cells / 2};
    }
    const double cells = std::min(*reach / spacing * (1 + 1e-9), static_cast<double>(most_lags));
    auto most = static_cast<std::int64_t>(cells);
    if (!axis.is_periodic) most = std::min(most, farthest);
    return {-most, most};
}

std::int64_t wrapped(std::int64_t n, std::int64_t period) {
    const std::int64_t rest = n % period;
    return rest < 0 ? rest + period : rest;
}

/// The smallest number that is at least `least` and has no prime factor above 7. Transforms of such
/// sizes are fast.
std::int64_t fast_size(std::int64_t least) {
    for (std::int64_t size = least;; ++size) {
        std::int64_t rest = size;
        for (const std::int64_t prime : {2, 3, 5, 7}) {
            while (rest % prime == 0) rest /= prime;
        }
        if (rest == 1) return size;
    }
}

}  // namespace

std::int64_t lags_in_box(const Grid& grid, std::optional<double> reach) {
    std::int64_t count = 1;
    for (const Extent& axis : extents_of(grid)) {
        const auto [first, last] = lags_along(axis, grid.spacing, reach);
        if (last - first + 1 > most_lags / count) return most_lags + 1;
        count *= last - first + 1;
    }
    return count;
}

std::optional<std::vector<Lag>> lags_within(const Grid& grid, std::optional<double> reach) {
    if (lags_in_box(grid, reach) > most_lags) return std::nullopt;
    const auto axes = extents_of(grid);
    std::array<std::pair<std::int64_t, std::int64_t>, 3> ranges;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ranges[axis] = lags_along(axes[axis], grid.spacing, reach);
    }
    std::vector<Lag> lags;
    const double most = reach ? *reach / grid.spacing * (1 + 1e-9) : INFINITY;
    for (std::int64_t z = ranges[2].first; z <= ranges[2].second; ++z) {
        for (std::int64_t y = ranges[1].first; y <= ranges[1].second; ++y) {
            for (std::int64_t x = ranges[0].first; x <= ranges[0].second; ++x) {
                const auto square = static_cast<double>(x * x + y * y + z * z);
                if (square <= most * most) lags.push_back({x, y, z});
            }
        }
    }
    return lags;
}

template <typename Number>
struct ConvolutionRunner<Number>::Implementation {
    using Complex = std::complex<Number>;
    using Transform = FftwTransform<Number>;
    using Lines = typename Transform::Lines;

    Implementation(const Grid& grid, const WeightedLags& weighted)
        : layout(grid), axes(extents_of(grid)), direct(weighted) {
        is_direct = weighted.lags.size() <= most_direct_lags;
        if (!is_direct) prepare(weighted);
    }

    // Computes sums directly.

    void add(Number* sums, const Number* row, std::int64_t by, Number weight) const {
        const std::int64_t width = layout.width;
        const auto add_range = [&](std::int64_t first, std::int64_t last, std::int64_t shift) {
            for (std::int64_t x = first; x < last; ++x) sums[x] += weight * row[x + shift];
        };
        if (!axes[0].is_periodic) {
            return add_range(std::max<std::int64_t>(0, -by), std::min(width, width - by), by);
        }
        const std::int64_t shift = wrapped(by, width);
        add_range(0, width - shift, shift);
        add_range(width - shift, width, shift - width);
    }

    /// The row or slice number `at`, wrapped into a periodic axis; nullopt if it is beyond a side.
    std::optional<std::int64_t> place(std::size_t axis, std::int64_t at) const {
        const Extent& extent = axes[axis];
        if (extent.is_periodic) return wrapped(at, extent.cells);
        return at >= 0 && at < extent.cells ? std::optional(at) : std::nullopt;
    }

    void sum_row(std::int64_t row, const Number* from, Number* to) const {
        const std::int64_t y = row % layout.height, z = row / layout.height;
        Number* const sums = to + layout.row_start(row);
        std::fill(sums, sums + layout.width, Number{0});
        for (std::size_t k = 0; k < direct.lags.size(); ++k) {
            const Lag& lag = direct.lags[k];
            const auto at_y = place(1, y + lag.y), at_z = place(2, z + lag.z);
            if (!at_y || !at_z) continue;
            add(sums, from + layout.row_start(*at_z * layout.height + *at_y), lag.x,
                static_cast<Number>(direct.weights[k]));
        }
    }

    // Computes sums by transforms.

    void prepare(const WeightedLags& weighted) {
        std::array<std::int64_t, 3> farthest{};
        for (const Lag& lag : weighted.lags) {
            const std::array along{lag.x, lag.y, lag.z};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                farthest[axis] = std::max(farthest[axis], std::abs(along[axis]));
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Extent& extent = axes[axis];
            const bool is_padded = !extent.is_periodic && extent.cells > 1;
            size[axis] = is_padded ? fast_size(extent.cells + farthest[axis]) : extent.cells;
        }
        const std::int64_t waves = size[0] / 2 + 1;
        blocks = (waves + columns_of_block - 1) / columns_of_block;
        stride = blocks * columns_of_block;
        buffer = make_buffer();
        kernel = make_buffer();
        make_transforms();
        // A sum over lags +l is a convolution with the kernel mirrored to lags −l. So the waves of
        // the plane are multiplied by the waves of the mirrored kernel.
        const double scale = 1.0 / static_cast<double>(size[0] * size[1] * size[2]);
        for (std::size_t k = 0; k < weighted.lags.size(); ++k) {
            const Lag& lag = weighted.lags[k];
            Number* const row =
                row_of(kernel.get(), wrapped(-lag.y, size[1]), wrapped(-lag.z, size[2]));
            row[wrapped(-lag.x, size[0])] += static_cast<Number>(weighted.weights[k] * scale);
        }
        for (std::int64_t row = 0; row < size[1] * size[2]; ++row) {
            Number* const at = row_of(kernel.get(), row % size[1], row / size[1]);
            there.run(at, at);
        }
        for (const std::size_t axis : {1, 2}) {
            for (std::int64_t piece = 0; piece < pieces(axis); ++piece) {
                transform_columns(axis, true, kernel.get(), piece);
            }
        }
    }

    struct Free {
        void operator()(Complex* data) const { free_plane(data); }
    };
    using Buffer = std::unique_ptr<Complex[], Free>;
    Buffer make_buffer() const {
        const auto count = static_cast<std::size_t>(stride * size[1] * size[2]);
        Buffer made(static_cast<Complex*>(allocate_plane(count * sizeof(Complex))));
        std::fill(made.get(), made.get() + count, Complex{});
        return made;
    }

    void make_transforms() {
        Number* const at = numbers(buffer.get());
        there = Transform(Transform::there, 0, size[0], 1, {at, 1, 0}, {at, 1, 0});
        back = Transform(Transform::back, 0, size[0], 1, {at, 1, 0}, {at, 1, 0});
        for (const std::size_t axis : {1, 2}) {
            if (size[axis] == 1) continue;
            const Lines lines{at, 2 * step(axis), 2};
            forward[axis] = Transform(Transform::complex, FFTW_FORWARD, size[axis],
                                      columns_of_block, lines, lines);
            backward[axis] = Transform(Transform::complex, FFTW_BACKWARD, size[axis],
                                       columns_of_block, lines, lines);
        }
    }

    static Number* numbers(Complex* waves) { return reinterpret_cast<Number*>(waves); }
    Number* row_of(Complex* waves, std::int64_t y, std::int64_t z) const {
        return numbers(waves + (z * size[1] + y) * stride);
    }
    /// The distance from one wave to the next along an axis, in waves.
    std::int64_t step(std::size_t axis) const { return axis == 1 ? stride : stride * size[1]; }
    /// The number of blocks of columns along an axis.
    std::int64_t pieces(std::size_t axis) const {
        if (size[axis] == 1) return 0;
        return blocks * (axis == 1 ? size[2] : size[1]);
    }
    std::int64_t start(std::size_t axis, std::int64_t piece) const {
        const std::int64_t other = piece / blocks;
        return piece % blocks * columns_of_block + other * step(axis == 1 ? 2 : 1);
    }
    void transform_columns(std::size_t axis, bool is_forward, Complex* waves,
                           std::int64_t piece) const {
        Number* const at = numbers(waves + start(axis, piece));
        (is_forward ? forward : backward)[axis].run(at, at);
    }
    void multiply(std::int64_t first, std::int64_t count) const {
        // The compiler vectorises these loops if it knows that the arrays do not overlap.
        Number* __restrict__ const a = numbers(buffer.get() + first);
        const Number* __restrict__ const b = numbers(kernel.get() + first);
        for (std::int64_t n = 0; n < 2 * count; n += 2) {
            const Number real = a[n] * b[n] - a[n + 1] * b[n + 1];
            const Number imaginary = a[n] * b[n + 1] + a[n + 1] * b[n];
            a[n] = real;
            a[n + 1] = imaginary;
        }
    }
    void multiply_columns(std::size_t axis, std::int64_t piece) const {
        for (std::int64_t n = 0; n < size[axis]; ++n) {
            multiply(start(axis, piece) + n * step(axis), columns_of_block);
        }
    }

    void load_row(std::int64_t row, const Number* from) const {
        const std::int64_t y = row % size[1], z = row / size[1];
        Number* const at = row_of(buffer.get(), y, z);
        std::fill(at, at + 2 * stride, Number{0});
        if (y >= layout.height || z >= layout.depth) return;
        const Number* const cells = from + layout.row_start(z * layout.height + y);
        std::copy(cells, cells + layout.width, at);
        there.run(at, at);
    }

    void by_transforms(Team& team, int thread, int threads, const Number* from, Number* to,
                       const std::atomic<bool>* cancel) const {
        const auto share = [&](std::int64_t count, const auto& act) {
            const RowRange own = split_rows(count, thread, threads);
            for (std::int64_t n = own.begin; n < own.end; ++n) {
                leave_if(cancel);
                act(n);
            }
        };
        const std::int64_t rows = size[1] * size[2];
        share(rows, [&](std::int64_t row) { load_row(row, from); });
        team.barrier();
        std::vector<std::size_t> along;
        for (const std::size_t axis : {1, 2}) {
            if (size[axis] > 1) along.push_back(axis);
        }
        for (std::size_t k = 0; k < along.size(); ++k) {
            const bool is_last = k + 1 == along.size();
            share(pieces(along[k]), [&](std::int64_t piece) {
                transform_columns(along[k], true, buffer.get(), piece);
                if (!is_last) return;
                multiply_columns(along[k], piece);
                transform_columns(along[k], false, buffer.get(), piece);
            });
            team.barrier();
        }
        if (along.size() == 2) {
            share(pieces(1),
                  [&](std::int64_t piece) { transform_columns(1, false, buffer.get(), piece); });
            team.barrier();
        }
        share(layout.row_count(), [&](std::int64_t row) {
            const std::int64_t y = row % layout.height, z = row / layout.height;
            Number* const at = row_of(buffer.get(), y, z);
            if (along.empty()) multiply((at - numbers(buffer.get())) / 2, stride);
            back.run(at, at);
            std::copy(at, at + layout.width, to + layout.row_start(row));
        });
    }

    PlaneLayout layout;
    std::array<Extent, 3> axes;
    WeightedLags direct;
    bool is_direct = false;
    std::array<std::int64_t, 3> size{1, 1, 1};  ///< The size of the transforms along each axis.
    std::int64_t blocks = 0;                    ///< Number of blocks of columns in a row of waves.
    std::int64_t stride = 0;                    ///< The distance between rows, in waves.
    Buffer buffer, kernel;
    Transform there, back;
    std::array<Transform, 3> forward, backward;
};

template <typename Number>
ConvolutionRunner<Number>::ConvolutionRunner(const Grid& grid, const WeightedLags& weighted)
    : self_(std::make_unique<Implementation>(grid, weighted)) {}
template <typename Number>
ConvolutionRunner<Number>::ConvolutionRunner(ConvolutionRunner&&) noexcept = default;
template <typename Number>
ConvolutionRunner<Number>::~ConvolutionRunner() = default;

template <typename Number>
void ConvolutionRunner<Number>::apply(Team& team, int thread, int threads, const Number* from,
                                      Number* to, const std::atomic<bool>* cancel) {
    team.barrier();  // All threads have written their rows, and none reads the target any more.
    if (self_->is_direct) {
        const RowRange own = split_rows(self_->layout.row_count(), thread, threads);
        for (std::int64_t row = own.begin; row < own.end; ++row) {
            leave_if(cancel);
            self_->sum_row(row, from, to);
        }
    } else {
        self_->by_transforms(team, thread, threads, from, to, cancel);
    }
    team.barrier();
}

template class ConvolutionRunner<float>;
template class ConvolutionRunner<double>;

}  // namespace cascade
