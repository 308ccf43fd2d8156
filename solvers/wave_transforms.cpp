// Whatever the number of threads, each call of FFTW transforms one row or sixteen neighbouring
// columns, so results are the same bit for bit. Plans are estimated, because measured plans would
// differ from run to run. The last axis is transformed from the plane to a buffer in which its
// lines are contiguous. For contiguous lines even estimated plans are fast.
//
// Along periodic rows, real numbers are transformed to complex numbers. From then on, columns are
// complex, and FFTW's complex transforms apply. FFTW uses vector instructions for complex
// transforms, but not for transforms of real numbers to real numbers.
#include "solvers/wave_transforms.h"

#include "core/plane.h"
#include "solvers/fftw_transform.h"
#include "solvers/leave_if.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace cascade {
namespace {

/// The waves along an axis, which depend on the rules at its two sides.
struct AxisWaves {
    int forward = FFTW_R2HC;
    int backward = FFTW_HC2R;
    double shift = 0;  ///< Wave n makes (n + shift) / 2 periods over the axis.
    /// Whether each wave has a whole number of periods. Waves are then in the order of FFTW_R2HC.
    bool is_periodic = false;

    friend bool operator==(const AxisWaves&, const AxisWaves&) = default;
};

AxisWaves waves_between(SideKind first, SideKind last) {
    if (first == SideKind::periodic) return {FFTW_R2HC, FFTW_HC2R, 0, true};
    const bool first_is_held = first == SideKind::fixed, last_is_held = last == SideKind::fixed;
    if (first_is_held && last_is_held) return {FFTW_RODFT10, FFTW_RODFT01, 1, false};
    if (first_is_held) return {FFTW_RODFT11, FFTW_RODFT11, 0.5, false};
    if (last_is_held) return {FFTW_REDFT11, FFTW_REDFT11, 0.5, false};
    return {FFTW_REDFT10, FFTW_REDFT01, 0, false};
}

using WavesOfAxes = std::array<AxisWaves, 3>;

WavesOfAxes waves_between(const SideRules& rules) {
    WavesOfAxes waves;
    for (std::size_t axis = 0; axis < waves.size(); ++axis) {
        waves[axis] = waves_between(rules.at[2 * axis].kind, rules.at[2 * axis + 1].kind);
    }
    return waves;
}

/// −4/h² sin²(half the phase from cell to cell): the factor by which the second difference
/// multiplies each wave.
template <typename Number>
std::vector<Number> second_differences(const AxisWaves& waves, std::int64_t cells, double spacing) {
    std::vector<Number> values(static_cast<std::size_t>(cells), Number{0});
    if (cells == 1) return values;
    const auto count = static_cast<double>(cells);
    for (std::int64_t n = 0; n < cells; ++n) {
        const double half_periods = waves.is_periodic
                                        ? 2 * static_cast<double>(std::min(n, cells - n))
                                        : static_cast<double>(n) + waves.shift;
        const double sine = std::sin(std::numbers::pi * half_periods / (2 * count));
        values[static_cast<std::size_t>(n)] =
            static_cast<Number>(-4 * sine * sine / (spacing * spacing));
    }
    return values;
}

/// sin(the phase from cell to cell)/h: the factor, divided by i, by which the central difference
/// multiplies each wave of a periodic axis. 0 for other axes, where the central difference turns
/// waves into other waves.
template <typename Number>
std::vector<Number> first_differences(const AxisWaves& waves, std::int64_t cells, double spacing) {
    std::vector<Number> values(static_cast<std::size_t>(cells), Number{0});
    if (!waves.is_periodic) return values;
    for (std::int64_t n = 0; n < cells; ++n) {
        const double phase =
            2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(cells);
        values[static_cast<std::size_t>(n)] = static_cast<Number>(std::sin(phase) / spacing);
    }
    return values;
}

/// The factor by which values grow in a transform followed by its inverse.
double gain_of(const AxisWaves& waves, std::int64_t cells) {
    return static_cast<double>(cells) * (waves.is_periodic ? 1 : 2);
}

}  // namespace

template <typename Number>
struct WaveTransforms<Number>::Implementation {
    using Block = WaveBlock<Number>;
    using Lines = typename FftwTransform<Number>::Lines;
    enum Axis : std::uint8_t { x, y, z };

    /// The transforms of species with the same kinds of sides.
    struct Shape {
        WavesOfAxes waves;
        std::int64_t columns = 0;    ///< The number of elements in a row of waves.
        bool lines_complex = false;  ///< Whether the buffer's lines hold complex numbers.
        double gain = 1;
        std::array<FftwTransform<Number>, 3> forward, backward;
        /// The factors of differences along each axis. Along x there is one factor per line of the
        /// buffer.
        std::array<std::vector<Number>, 3> differences;
        /// The factors of central differences along x and y, laid out like `differences`.
        std::array<std::vector<Number>, 2> slopes;
    };
    struct Free {
        void operator()(Number* data) const { free_plane(data); }
    };
    using Buffer = std::unique_ptr<Number[], Free>;

    Implementation(const Grid& its_grid, const std::vector<SideRules>& sides)
        : layout(its_grid), grid(its_grid) {
        for (std::uint8_t axis = x; axis <= z; ++axis) {
            if (cells(axis) > 1) axes.push_back(static_cast<Axis>(axis));
        }
        for (const SideRules& rules : sides) {
            const WavesOfAxes waves = waves_between(rules);
            std::size_t same = 0;
            while (same < shapes.size() && !(shapes[same].waves == waves)) ++same;
            if (same == shapes.size()) shapes.push_back(shape(waves));
            shape_of.push_back(same);
        }
    }

    std::int64_t cells(std::uint8_t axis) const {
        return axis == x ? layout.width : axis == y ? layout.height : layout.depth;
    }
    std::int64_t stride(Axis axis) const {
        return axis == x ? 1 : axis == y ? layout.stride : layout.slice_stride;
    }
    /// The size of the buffer for one block.
    std::int64_t buffer_size() const {
        return axes.back() == x ? layout.width + 2 : Block::columns * cells(axes.back());
    }
    Buffer buffer(std::size_t blocks) const {
        const std::size_t bytes = blocks * static_cast<std::size_t>(buffer_size()) * sizeof(Number);
        return Buffer(static_cast<Number*>(allocate_plane(bytes)));
    }

    Shape shape(const WavesOfAxes& waves) const {
        Shape made;
        made.waves = waves;
        const bool rows_complex = axes.front() == x && waves[x].is_periodic;
        const Axis last = axes.back();
        made.columns = rows_complex ? (layout.width / 2 + 1) * 2 : layout.width;
        made.lines_complex = rows_complex && waves[last].is_periodic;
        // Planning reads no values, but the plane must be aligned like the planes that are
        // transformed later.
        Plane<Number> plane(layout);
        const Buffer block = buffer(1);
        for (const Axis axis : axes) {
            made.gain *= gain_of(waves[axis], cells(axis));
            using Kind = typename FftwTransform<Number>::Kind;
            const bool is_complex = rows_complex && waves[axis].is_periodic;
            const Kind there = !is_complex ? FftwTransform<Number>::real
                               : axis == x ? FftwTransform<Number>::there
                                           : FftwTransform<Number>::complex;
            const Kind back =
                there == FftwTransform<Number>::there ? FftwTransform<Number>::back : there;
            const std::int64_t part = is_complex && axis != x ? 2 : 1;
            const std::int64_t count = axis == x ? 1 : Block::columns / part;
            const Lines in_plane{plane.origin(), stride(axis), part};
            const Lines inside =
                axis == last ? Lines{block.get(), part, part * cells(axis)} : in_plane;
            const auto make = [&](Kind kind, int direction, const Lines& from, const Lines& to) {
                return FftwTransform<Number>(kind, direction, cells(axis), count, from, to);
            };
            made.forward[axis] =
                make(there, is_complex ? FFTW_FORWARD : waves[axis].forward, in_plane, inside);
            made.backward[axis] =
                make(back, is_complex ? FFTW_BACKWARD : waves[axis].backward, inside, in_plane);
        }
        for (std::uint8_t axis = x; axis <= z; ++axis) {
            made.differences[axis] =
                second_differences<Number>(waves[axis], cells(axis), grid.spacing);
        }
        for (const std::uint8_t axis : {x, y}) {
            made.slopes[axis] = first_differences<Number>(waves[axis], cells(axis), grid.spacing);
        }
        if (rows_complex && !made.lines_complex) {
            // The real and the imaginary part of a wave are separate columns.
            for (std::vector<Number>* along_x : {&made.differences[x], &made.slopes[x]}) {
                const std::vector<Number> of_waves = std::exchange(*along_x, {});
                for (std::int64_t n = 0; n < made.columns; ++n) {
                    along_x->push_back(of_waves[static_cast<std::size_t>(n / 2)]);
                }
            }
        }
        return made;
    }

    std::int64_t blocks(const Shape& one) const {
        return (one.columns + Block::columns - 1) / Block::columns;
    }
    /// The number of independent parts of a transform along an axis. A part of the transform along
    /// x is a row with its usual number, so threads share rows as they do for kernels.
    std::int64_t pieces(const Shape& one, Axis axis) const {
        if (axis == x) return layout.row_count();
        return blocks(one) * (axis == y ? layout.depth : layout.height);
    }
    /// The number of elements from cell (0, 0, 0) to the first element of a piece.
    std::int64_t start(const Shape& one, Axis axis, std::int64_t piece) const {
        if (axis == x) return layout.row_start(piece);
        const std::int64_t other = piece / blocks(one);
        return piece % blocks(one) * Block::columns +
               other * (axis == y ? layout.slice_stride : layout.stride);
    }
    Block block(const Shape& one, std::int64_t piece, std::span<Number* const> waves) const {
        const Axis last = axes.back();
        const std::int64_t part = one.lines_complex ? 2 : 1;
        const std::int64_t first = last == x ? 0 : piece % blocks(one) * Block::columns;
        Block made;
        made.offset = last == x ? layout.row_start(piece) : piece * buffer_size();
        made.axis = last;
        made.is_complex = one.lines_complex;
        made.lines = last == x ? 1 : std::min(Block::columns, one.columns - first) / part;
        made.count = last == x ? one.columns / part : cells(last);
        made.differences[x] = one.differences[x].data() + first / part;
        const std::int64_t row = last == z ? piece / blocks(one) : 0;
        made.differences[y] = one.differences[y].data() + row;
        made.differences[z] = one.differences[z].data();
        made.slopes[x] = one.slopes[x].data() + first / part;
        made.slopes[y] = one.slopes[y].data() + row;
        made.gain = one.gain;
        made.waves = waves;
        return made;
    }

    /// A row of cells of a species that is not transformed.
    Block row(const Shape& one, std::int64_t number, std::span<Number* const> cells) const {
        Block made;
        made.offset = layout.row_start(number);
        made.lines = 1;
        made.count = layout.width;
        for (std::uint8_t axis = x; axis <= z; ++axis) {
            made.differences[axis] = one.differences[axis].data();
        }
        for (const std::uint8_t axis : {x, y}) made.slopes[axis] = one.slopes[axis].data();
        made.waves = cells;
        return made;
    }

    /// Visits these rows of all species that are not transformed.
    void visit_rows(const RowRange& rows, const std::vector<bool>& transformed,
                    std::span<const std::span<Number* const>> to, const Visit& visit) const {
        std::vector<Number*> waves(to.size());
        for (std::size_t s = 0; s < transformed.size(); ++s) {
            if (transformed[s]) continue;
            for (std::int64_t number = rows.begin; number < rows.end; ++number) {
                for (std::size_t k = 0; k < to.size(); ++k) {
                    waves[k] = to[k][s] + layout.row_start(number);
                }
                Block block = row(shapes[shape_of[s]], number, waves);
                block.species = s;
                visit(block);
            }
        }
    }

    PlaneLayout layout;
    Grid grid;
    std::vector<Axis> axes;  ///< The axes of more than one cell, in the order of transforms.
    std::vector<Shape> shapes;
    std::vector<std::size_t> shape_of;  ///< The index of each species' shape.
};

template <typename Number>
WaveTransforms<Number>::WaveTransforms(const Grid& grid, const std::vector<SideRules>& sides)
    : self_(std::make_unique<Implementation>(grid, sides)) {}
template <typename Number>
WaveTransforms<Number>::WaveTransforms(WaveTransforms&&) noexcept = default;
template <typename Number>
WaveTransforms<Number>::~WaveTransforms() = default;

template <typename Number>
void WaveTransforms<Number>::apply(Team& team, int thread, int threads,
                                   const std::vector<bool>& transformed,
                                   std::span<const std::span<Number* const>> to, const Visit& visit,
                                   const std::atomic<bool>* cancel) const {
    using Axis = typename Implementation::Axis;
    const Implementation& self = *self_;
    const auto for_pieces = [&](Axis axis, const auto& act) {
        for (std::size_t s = 0; s < transformed.size(); ++s) {
            if (!transformed[s]) continue;
            const auto& shape = self.shapes[self.shape_of[s]];
            const RowRange own = split_rows(self.pieces(shape, axis), thread, threads);
            for (std::int64_t piece = own.begin; piece < own.end; ++piece) {
                leave_if(cancel);
                act(shape, s, piece, self.start(shape, axis, piece));
            }
        }
    };
    self.visit_rows(split_rows(self.layout.row_count(), thread, threads), transformed, to, visit);
    // Threads have the same rows as in kernels, but not the same columns.
    const bool begins_with_rows = self.axes.front() == Axis::x;
    if (!begins_with_rows) team.barrier();
    for (std::size_t n = 0; n + 1 < self.axes.size(); ++n) {
        const Axis axis = self.axes[n];
        for_pieces(axis, [&](const auto& shape, std::size_t s, std::int64_t, std::int64_t start) {
            shape.forward[axis].run(to[0][s] + start, to[0][s] + start);
        });
        team.barrier();
    }
    // The transform is complete after the last axis.
    const Axis last = self.axes.back();
    const auto buffer = self.buffer(to.size());
    std::vector<Number*> waves(to.size());
    for (std::size_t k = 0; k < to.size(); ++k) {
        waves[k] = buffer.get() + static_cast<std::int64_t>(k) * self.buffer_size();
    }
    for_pieces(last, [&](const auto& shape, std::size_t s, std::int64_t piece, std::int64_t start) {
        shape.forward[last].run(to[0][s] + start, waves[0]);
        WaveBlock<Number> block = self.block(shape, piece, waves);
        block.species = s;
        visit(block);
        for (std::size_t k = 0; k < to.size(); ++k) {
            shape.backward[last].run(waves[k], to[k][s] + start);
        }
    });
    for (std::size_t n = self.axes.size() - 1; n-- > 0;) {
        const Axis axis = self.axes[n];
        team.barrier();
        for_pieces(axis, [&](const auto& shape, std::size_t s, std::int64_t, std::int64_t start) {
            for (const auto& planes : to) {
                shape.backward[axis].run(planes[s] + start, planes[s] + start);
            }
        });
    }
    if (!begins_with_rows) team.barrier();
}

template class WaveTransforms<float>;
template class WaveTransforms<double>;

}  // namespace cascade
