// Waves come from FFTW's transforms of real numbers, one axis after the other. Each call transforms
// one row or sixteen neighbouring columns, whatever the number of threads, so bits do not depend on
// it. Plans are estimated and not measured: measuring would choose differently from run to run.
#include "solvers/wave_filter.h"

#include "core/check.h"
#include "core/late_library.h"
#include "core/plane.h"
#include "core/transform_planner.h"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

namespace cascade {
namespace {

/// FFTW's functions in both precisions.
template <typename Number>
struct Fftw;
template <>
struct Fftw<float> {
    using Plan = fftwf_plan;
    LateLibrary library{CASCADE_FFTW_FLOAT_LIBRARY};
    decltype(&fftwf_plan_many_r2r) plan_many = library["fftwf_plan_many_r2r"];
    decltype(&fftwf_execute_r2r) execute = library["fftwf_execute_r2r"];
    decltype(&fftwf_destroy_plan) destroy = library["fftwf_destroy_plan"];
};
template <>
struct Fftw<double> {
    using Plan = fftw_plan;
    LateLibrary library{CASCADE_FFTW_LIBRARY};
    decltype(&fftw_plan_many_r2r) plan_many = library["fftw_plan_many_r2r"];
    decltype(&fftw_execute_r2r) execute = library["fftw_execute_r2r"];
    decltype(&fftw_destroy_plan) destroy = library["fftw_destroy_plan"];
};

template <typename Number>
const Fftw<Number>& fftw() {
    static const Fftw<Number> functions;
    return functions;
}

/// The waves along an axis, which depend on the rules at its two sides.
struct AxisWaves {
    fftw_r2r_kind forward = FFTW_R2HC;
    fftw_r2r_kind backward = FFTW_HC2R;
    double shift = 0;          ///< Wave n makes (n + shift) / 2 periods over the axis.
    bool is_periodic = false;  ///< Waves are whole periods, in the order of FFTW_R2HC.
};

AxisWaves waves_between(SideKind first, SideKind last) {
    if (first == SideKind::periodic) return {FFTW_R2HC, FFTW_HC2R, 0, true};
    const bool first_is_held = first == SideKind::fixed, last_is_held = last == SideKind::fixed;
    if (first_is_held && last_is_held) return {FFTW_RODFT10, FFTW_RODFT01, 1, false};
    if (first_is_held) return {FFTW_RODFT11, FFTW_RODFT11, 0.5, false};
    if (last_is_held) return {FFTW_REDFT11, FFTW_REDFT11, 0.5, false};
    return {FFTW_REDFT10, FFTW_REDFT01, 0, false};
}

/// −4/h² sin²(half the phase from cell to cell): the factor by which the second difference
/// multiplies each wave.
template <typename Number>
std::vector<Number> second_differences(const AxisWaves& waves, std::int64_t cells, double spacing,
                                       std::int64_t room) {
    std::vector<Number> values(static_cast<std::size_t>(room), Number{0});
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

/// The factor by which a transform and its inverse together multiply.
double gain_of(const AxisWaves& waves, std::int64_t cells) {
    return static_cast<double>(cells) * (waves.is_periodic ? 1 : 2);
}

/// This number of columns is transformed at a time: they share cache lines.
constexpr std::int64_t block = PlaneLayout::row_pad;

}  // namespace

template <typename Number>
struct WaveFilter<Number>::Implementation {
    using Plan = typename Fftw<Number>::Plan;
    enum Axis : std::uint8_t { x, y, z };

    /// One axis of one species.
    struct Along {
        Plan forward = nullptr, backward = nullptr;
        const std::vector<Number>* differences = nullptr;
    };
    struct Species {
        std::array<Along, 3> along;
        double gain = 1;
    };
    /// The address of a row of cells, and the number of its cells.
    struct Line {
        std::int64_t offset, column, count, row, slice;
    };

    Implementation(const Grid& its_grid, const std::vector<SideRules>& sides)
        : layout(its_grid), grid(its_grid) {
        const std::array<std::int64_t, 3> cells{grid.width, grid.height, grid.depth};
        for (std::uint8_t axis = x; axis <= z; ++axis) {
            if (cells[axis] > 1) axes.push_back(static_cast<Axis>(axis));
        }
        for (const SideRules& rules : sides) {
            Species& one = species.emplace_back();
            for (std::uint8_t axis = x; axis <= z; ++axis) {
                const AxisWaves waves =
                    waves_between(rules.at[2 * axis].kind, rules.at[2 * axis + 1].kind);
                one.along[axis] = along(static_cast<Axis>(axis), waves, cells[axis]);
                if (cells[axis] > 1) one.gain *= gain_of(waves, cells[axis]);
            }
        }
    }
    ~Implementation() {
        const std::lock_guard lock(transform_planner());
        for (const auto& [key, plan] : plans) fftw<Number>().destroy(plan);
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    Along along(Axis axis, const AxisWaves& waves, std::int64_t cells) {
        Along result;
        auto& values = differences[{axis, waves.forward}];
        if (values.empty()) {
            const std::int64_t room = (cells + block - 1) / block * block;
            values = second_differences<Number>(waves, cells, grid.spacing, room);
            if (cells == 1) values[0] = 0;
        }
        result.differences = &values;
        if (cells == 1) return result;
        result.forward = plan(axis, waves.forward, cells);
        result.backward = plan(axis, waves.backward, cells);
        return result;
    }

    Plan plan(Axis axis, fftw_r2r_kind kind, std::int64_t cells) {
        Plan& known = plans[{axis, kind}];
        if (known != nullptr) return known;
        // Estimating reads no values; a plane made for it is aligned like those to come.
        Plane<Number> like(layout);
        Number* const place = like.origin();
        const int size = static_cast<int>(cells);
        const std::int64_t stride = axis == x ? 1 : axis == y ? layout.stride : layout.slice_stride;
        const int many = axis == x ? 1 : static_cast<int>(block);
        const std::lock_guard lock(transform_planner());
        known = fftw<Number>().plan_many(1, &size, many, place, nullptr, static_cast<int>(stride),
                                         1, place, nullptr, static_cast<int>(stride), 1, &kind,
                                         FFTW_ESTIMATE);
        CHECK(known != nullptr, "FFTW has a plan for every size");
        return known;
    }

    std::int64_t blocks() const { return (layout.width + block - 1) / block; }
    /// Independent parts of a transform along an axis. Rows are numbered as everywhere, so that
    /// threads share them as for kernels.
    /// threads share them as they do for kernels.
    std::int64_t pieces(Axis axis) const {
        if (axis == x) return layout.row_count();
        return blocks() * (axis == y ? layout.depth : layout.height);
    }
    Line first_line(Axis axis, std::int64_t piece) const {
        if (axis == x) {
            return {layout.row_start(piece), 0, layout.width, piece % layout.height,
                    piece / layout.height};
        }
        const std::int64_t column = piece % blocks() * block;
        const std::int64_t count = std::min(block, layout.width - column);
        const std::int64_t other = piece / blocks();
        if (axis == y) return {other * layout.slice_stride + column, column, count, 0, other};
        return {other * layout.stride + column, column, count, other, 0};
    }

    void multiply_piece(Axis axis, std::int64_t piece, const Species& one, Number* plane,
                        const DiffusionSymbol& symbol, WaveResponse response, double length) const {
        Line line = first_line(axis, piece);
        const std::int64_t lines = axis == x ? 1 : axis == y ? layout.height : layout.depth;
        for (std::int64_t n = 0; n < lines; ++n) {
            multiply(line, one, plane, symbol, response, length);
            line.offset += axis == y ? layout.stride : layout.slice_stride;
            ++(axis == y ? line.row : line.slice);
        }
    }

    void multiply(const Line& line, const Species& one, Number* plane,
                  const DiffusionSymbol& symbol, WaveResponse response, double length) const {
        const Number* const along_x = one.along[x].differences->data() + line.column;
        const Number of_y = (*one.along[y].differences)[static_cast<std::size_t>(line.row)];
        const Number of_z = (*one.along[z].differences)[static_cast<std::size_t>(line.slice)];
        DiffusionTerms<Number> f;
        for (std::size_t n = 0; n < f.size(); ++n) f[n] = static_cast<Number>(length * symbol[n]);
        const Number of_rest = f[5] * of_y + f[6] * of_z;
        const auto part = static_cast<Number>(1 / one.gain);
        Number* const cells = plane + line.offset;
        for (std::int64_t i = 0; i < line.count; ++i) {
            const Number q = -((along_x[i] + of_y) + of_z);
            const Number of_axes = f[4] * along_x[i] + of_rest;
            const Number change = of_axes - q * (f[0] + q * (f[1] + q * (f[2] + q * f[3])));
            const Number damping = change < 0 ? -change : Number{0};
            if (response == WaveResponse::implicit) {
                cells[i] *= part / (1 + damping);
            } else {
                cells[i] *= damping > 0 ? part * (-std::expm1(-damping) / damping) : part;
            }
        }
    }

    PlaneLayout layout;
    Grid grid;
    std::vector<Axis> axes;  ///< The axes of more than one cell, in the order of transforms.
    std::vector<Species> species;
    std::map<std::pair<Axis, fftw_r2r_kind>, Plan> plans;
    std::map<std::pair<Axis, fftw_r2r_kind>, std::vector<Number>> differences;
};

template <typename Number>
WaveFilter<Number>::WaveFilter(const Grid& grid, const std::vector<SideRules>& sides)
    : self_(std::make_unique<Implementation>(grid, sides)) {}
template <typename Number>
WaveFilter<Number>::WaveFilter(WaveFilter&&) noexcept = default;
template <typename Number>
WaveFilter<Number>::~WaveFilter() = default;

template <typename Number>
void WaveFilter<Number>::apply(Team& team, int thread, int threads, std::span<Number* const> planes,
                               std::span<const DiffusionSymbol> symbols, WaveResponse response,
                               double length) const {
    using Axis = typename Implementation::Axis;
    const Implementation& self = *self_;
    const auto for_pieces = [&](Axis axis, const auto& visit) {
        const RowRange own = split_rows(self.pieces(axis), thread, threads);
        for (std::size_t s = 0; s < planes.size(); ++s) {
            // Species without diffusion do not change.
            const auto is_none = [](double factor) { return factor == 0; };
            if (std::all_of(symbols[s].begin(), symbols[s].end(), is_none)) continue;
            for (std::int64_t piece = own.begin; piece < own.end; ++piece) {
                visit(self.species[s], piece, planes[s], symbols[s]);
            }
        }
    };
    const auto transform = [&](auto plan, Axis axis, std::int64_t piece, Number* plane) {
        Number* const cells = plane + self.first_line(axis, piece).offset;
        fftw<Number>().execute(plan, cells, cells);
    };
    // Rows are shared as for kernels, columns are not.
    const bool begins_with_rows = self.axes.front() == Axis::x;
    if (!begins_with_rows) team.barrier();
    for (std::size_t n = 0; n + 1 < self.axes.size(); ++n) {
        const Axis axis = self.axes[n];
        for_pieces(axis, [&](const auto& one, std::int64_t piece, Number* plane, const auto&) {
            transform(one.along[axis].forward, axis, piece, plane);
        });
        team.barrier();
    }
    // After the last axis the transform is complete.
    const Axis last = self.axes.back();
    for_pieces(last, [&](const auto& one, std::int64_t piece, Number* plane, const auto& symbol) {
        transform(one.along[last].forward, last, piece, plane);
        self.multiply_piece(last, piece, one, plane, symbol, response, length);
        transform(one.along[last].backward, last, piece, plane);
    });
    for (std::size_t n = self.axes.size() - 1; n-- > 0;) {
        const Axis axis = self.axes[n];
        team.barrier();
        for_pieces(axis, [&](const auto& one, std::int64_t piece, Number* plane, const auto&) {
            transform(one.along[axis].backward, axis, piece, plane);
        });
    }
    if (!begins_with_rows) team.barrier();
}

template class WaveFilter<float>;
template class WaveFilter<double>;

}  // namespace cascade
