#include "bench/peers/halide_side.h"

#include "bench/straight_cpp.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace cascade::bench {
namespace {

using Halide::Expr;
using Halide::Func;
using Halide::TailStrategy;
using Halide::Tuple;
using Halide::Var;

constexpr int vector_cells = 16;
constexpr int halo = HalideProgram::most_steps;

/// The values of species around a cell, in one step.
class Around {
public:
    Around(const Func& step, const Var& x, const Var& y) : step_(step), x_(x), y_(y) {}

    Expr operator[](int species) const { return at(species, 0, 0); }
    Expr laplacian(int species) const {
        return at(species, 0, -1) + at(species, 0, 1) + at(species, 1, 0) + at(species, -1, 0) -
               4.0F * at(species, 0, 0);
    }

private:
    Expr at(int species, int columns, int rows) const {
        return step_(x_ + columns, y_ + rows)[species];
    }

    const Func& step_;
    const Var& x_;
    const Var& y_;
};

Tuple turing(const Around& c, const Expr& beta, const Expr& frozen) {
    const StraightConstants k;
    const Expr ab = c[0] * c[1];
    const Expr rate_a = k.ka * (16.0F - ab) + k.diff_a * c.laplacian(0);
    const Expr rate_b = k.ka * (ab - c[1] - beta) + k.diff_b * c.laplacian(1);
    const Expr weight = select(frozen != Halide::cast<std::uint8_t>(0), 0.0F, k.speed);
    return {c[0] + weight * rate_a, max(c[1] + weight * rate_b, 0.0F)};
}

Tuple gray_scott(const Around& c) {
    const StraightConstants k;
    const Expr rate = c[0] * c[1] * c[1];
    return {c[0] + k.speed * (k.diff_u * c.laplacian(0) - rate + k.feed * (1.0F - c[0])),
            c[1] + k.speed * (k.diff_v * c.laplacian(1) + rate - (k.feed + k.kill) * c[1])};
}

Tuple stripes(const Around& c, const Expr& ai) {
    const StraightConstants k;
    const Expr made_a = 0.01F * c[0] * c[0] * c[4] * ai;
    const Expr made_b = 0.01F * c[1] * c[1] * c[3];
    return Tuple(
        std::vector<Expr>{c[0] + k.speed * (made_a / c[2] - k.p1 * c[0] + k.diff1 * c.laplacian(0)),
                          c[1] + k.speed * (made_b / c[2] - k.p1 * c[1] + k.diff1 * c.laplacian(1)),
                          c[2] + k.speed * (made_a + made_b - k.p2 * c[2]),
                          c[3] + k.speed * (k.p3 * (c[0] - c[3]) + k.diff2 * c.laplacian(3)),
                          c[4] + k.speed * (k.p3 * (c[1] - c[4]) + k.diff2 * c.laplacian(4))});
}

}  // namespace

std::string HalideSchedule::name() const {
    const std::string wide = width > 0 ? fmt::format(" {} wide", width) : "";
    switch (kind) {
        case Kind::rows: return height > 1 ? fmt::format("{} rows at once", height) : "rows";
        case Kind::tiles: return fmt::format("{} steps in tiles {} x {}", steps, width, height);
        case Kind::windows: return fmt::format("{} steps in windows{}", steps, wide);
    }
    return "";
}

HalideProgram::HalideProgram(HalideSystem system, const HalideSchedule& schedule)
    : schedule_(schedule), target_(Halide::get_host_target()) {
    std::vector<Expr> cells;
    const int species = system == HalideSystem::stripes ? 5 : 2;
    for (int k = 0; k < species; ++k)
        cells.push_back(now_.emplace_back(Halide::Float(32), 2)(x_, y_));
    steps_.emplace_back("old_step");
    steps_.back()(x_, y_) = Tuple(cells);
    for (int step = 0; step < schedule.steps; ++step) add_step(system);
    apply_schedule();
    pipeline_ = Halide::Pipeline(steps_.back());
    pipeline_.compile_jit(target_);
}

void HalideProgram::add_step(HalideSystem system) {
    const Around old(steps_.back(), x_, y_);
    const auto next = [&]() -> Tuple {
        switch (system) {
            case HalideSystem::turing: return turing(old, varying_(x_, y_), frozen_(x_, y_));
            case HalideSystem::gray_scott: return gray_scott(old);
            case HalideSystem::stripes: break;
        }
        return stripes(old, varying_(x_, y_));
    }();
    Func step(fmt::format("step_{}_", steps_.size()));
    step(x_, y_) = next;
    steps_.push_back(std::move(step));
}

void HalideProgram::apply_schedule() {
    const Var tile_x("tile_x"), tile_y("tile_y"), x("x_in_tile"), y("y_in_tile");
    Func& last = steps_.back();
    // The last vector of a row is shifted back and overlaps the one before it, so that steps before
    // the last compute no further columns.
    const auto inner_steps = [&](auto place) {
        for (std::size_t step = 1; step + 1 < steps_.size(); ++step) {
            steps_[step].vectorize(x_, vector_cells, TailStrategy::ShiftInwards);
            place(steps_[step]);
        }
    };
    switch (schedule_.kind) {
        case HalideSchedule::Kind::rows:
            last.vectorize(x_, vector_cells).unroll(y_, schedule_.height);
            break;
        case HalideSchedule::Kind::tiles:
            last.tile(x_, y_, tile_x, tile_y, x, y, schedule_.width, schedule_.height)
                .vectorize(x, vector_cells);
            inner_steps([&](Func& step) { step.compute_at(last, tile_x); });
            break;
        case HalideSchedule::Kind::windows:
            if (schedule_.width == 0) {
                last.vectorize(x_, vector_cells);
                inner_steps([&](Func& step) { step.store_root().compute_at(last, y_); });
            } else {
                last.split(x_, tile_x, x, schedule_.width)
                    .reorder(x, y_, tile_x)
                    .vectorize(x, vector_cells);
                inner_steps([&](Func& step) { step.store_at(last, tile_x).compute_at(last, y_); });
            }
            break;
    }
}

void HalideProgram::run(const std::vector<Halide::Buffer<float>>& now,
                        const Halide::Buffer<float>& varying,
                        const Halide::Buffer<std::uint8_t>& frozen,
                        const std::vector<Halide::Buffer<float>>& next) {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k].set(now[k]);
    if (varying.defined()) varying_.set(varying);
    if (frozen.defined()) frozen_.set(frozen);
    std::vector<Halide::Buffer<>> results;
    for (const Halide::Buffer<float>& plane : next) {
        // A view of the same cells without the halo.
        results.emplace_back(Halide::Buffer<float>(plane.get()
                                                       ->cropped(0, 0, plane.width() - 2 * halo)
                                                       .cropped(1, 0, plane.height() - 2 * halo)));
    }
    pipeline_.realize(Halide::Realization(results), target_);
}

HalideSide::HalideSide(const CascadeSide& like, const std::string& varying) : layout_(like.grid()) {
    for (const Field& field : like.start().species()) {
        now_.push_back(plane_like(field.origin()));
        next_.push_back(plane_like(field.origin()));
    }
    if (!varying.empty()) varying_ = plane_like(like.parameter(varying).origin());
    if (!like.start().frozen().empty()) frozen_ = plane_like(like.start().frozen().origin());
}

template <typename Number>
Halide::Buffer<Number> HalideSide::plane_like(const Number* origin) const {
    Halide::Buffer<Number> plane(static_cast<int>(layout_.width) + 2 * halo,
                                 static_cast<int>(layout_.height) + 2 * halo);
    plane.set_min(-halo, -halo);
    for (int row = 0; row < layout_.height; ++row) {
        std::memcpy(&plane(0, row), origin + row * layout_.stride,
                    static_cast<std::size_t>(layout_.width) * sizeof(Number));
    }
    fill_halo(plane, halo);
    return plane;
}

/// Fills the halo up to `reach` cells from the sides.
template <typename Number>
void HalideSide::fill_halo(Halide::Buffer<Number>& plane, int reach) const {
    const int width = static_cast<int>(layout_.width), height = static_cast<int>(layout_.height);
    const auto bytes_of = [](int cells) {
        return static_cast<std::size_t>(cells) * sizeof(Number);
    };
    for (int row = 0; row < height; ++row) {
        Number* cells = &plane(0, row);
        std::memcpy(cells - reach, cells + width - reach, bytes_of(reach));
        std::memcpy(cells + width, cells, bytes_of(reach));
    }
    const std::size_t bytes = bytes_of(width + 2 * reach);
    for (int row = 0; row < reach; ++row) {
        std::memcpy(&plane(-reach, row - reach), &plane(-reach, height - reach + row), bytes);
        std::memcpy(&plane(-reach, height + row), &plane(-reach, row), bytes);
    }
}

void HalideSide::advance(HalideProgram& program, std::int64_t count) {
    const int steps = program.schedule().steps;
    for (std::int64_t taken = 0; taken < count; taken += steps) {
        for (Plane& plane : now_) fill_halo(plane, steps);
        program.run(now_, varying_, frozen_, next_);
        now_.swap(next_);
    }
}

std::vector<Field> HalideSide::species() const {
    std::vector<Field> copies;
    for (const Plane& plane : now_) {
        Field& copy = copies.emplace_back(layout_);
        for (int row = 0; row < layout_.height; ++row) {
            std::memcpy(copy.row(row), &plane(0, row),
                        static_cast<std::size_t>(layout_.width) * sizeof(float));
        }
    }
    return copies;
}

}  // namespace cascade::bench
