// For comparison: the same steps by Halide on one core, with schedules written by hand.
//
// Halide separates what is computed from the order in which it is computed (J. Ragan-Kelley et al.,
// "Halide: a language and compiler for optimizing parallelism, locality, and recomputation in image
// processing pipelines", PLDI 2013). Several steps are one pipeline here, so that a schedule may
// bring cells into the cache once for all of these steps.
#pragma once

#include "bench/cascade_side.h"

#include <Halide.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {

/// The computed system: one of the scripts of cascade_side.h.
enum class HalideSystem { turing, gray_scott, stripes };

/// The order of computation.
struct HalideSchedule {
    enum class Kind {
        rows,  ///< One step per pass through memory, several rows at once.
        /// Tiles. Steps before the last also compute the cells around a tile that later steps read.
        tiles,
        /// Row by row through all steps. Steps before the last compute only the rows that the next
        /// step needs.
        windows,
    };
    Kind kind = Kind::rows;
    int steps = 1;   ///< Steps per pass through memory, at most HalideProgram::most_steps.
    int width = 0;   ///< The width of tiles, or of strips for windows. 0 means the grid's width.
    int height = 1;  ///< The height of tiles. For `rows`, the number of rows at once.

    std::string name() const;
};

/// The pipeline of one system with one schedule, compiled for this processor.
class HalideProgram {
public:
    static constexpr int most_steps = 16;

    HalideProgram(HalideSystem system, const HalideSchedule& schedule);

    const HalideSchedule& schedule() const { return schedule_; }

    /// Takes as many steps as the schedule has, from `now` to the cells [0, W) × [0, H) of `next`.
    /// Planes have a halo of most_steps cells. A schedule of n steps reads the n halo cells next to
    /// the grid.
    void run(const std::vector<Halide::Buffer<float>>& now, const Halide::Buffer<float>& varying,
             const Halide::Buffer<std::uint8_t>& frozen,
             const std::vector<Halide::Buffer<float>>& next);

private:
    void add_step(HalideSystem system);
    void apply_schedule();

    HalideSchedule schedule_;
    std::vector<Halide::ImageParam> now_;
    Halide::ImageParam varying_{Halide::Float(32), 2}, frozen_{Halide::UInt(8), 2};
    Halide::Var x_{"x"}, y_{"y"};
    /// The functions of all steps, from the old one to the new one.
    std::vector<Halide::Func> steps_;
    Halide::Target target_;
    Halide::Pipeline pipeline_;
};

/// Planes of a periodic grid, with the starting values of Cascade's side.
class HalideSide {
public:
    /// `varying` is the name of the parameter that varies by cell, or empty.
    HalideSide(const CascadeSide& like, const std::string& varying);

    /// Takes `count` steps with a program of the same system. `count` is a multiple of the number
    /// of steps of the program's schedule.
    void advance(HalideProgram& program, std::int64_t count);

    /// Copies of the species.
    std::vector<Field> species() const;

private:
    using Plane = Halide::Buffer<float>;

    template <typename Number>
    Halide::Buffer<Number> plane_like(const Number* origin) const;
    template <typename Number>
    void fill_halo(Halide::Buffer<Number>& plane, int reach) const;

    PlaneLayout layout_;
    std::vector<Plane> now_, next_;
    Plane varying_;
    Halide::Buffer<std::uint8_t> frozen_;
};

}  // namespace cascade::bench
