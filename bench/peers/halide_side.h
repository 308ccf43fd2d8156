// A peer: the same steps by Halide, one core, with schedules written by hand.
//
// Halide separates what is computed from the order in which it is (J. Ragan-Kelley et al., "Halide:
// a language and compiler for optimizing parallelism, locality, and recomputation in image
// processing pipelines", PLDI 2013). Several steps are one pipeline here, so that a schedule may
// bring cells into the cache once for all of them.
#pragma once

#include "bench/cascade_side.h"

#include <Halide.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {

/// What is computed: the systems of the texts of cascade_side.h.
enum class HalideSystem { turing, gray_scott, stripes };

/// In which order.
struct HalideSchedule {
    enum class Kind {
        rows,     ///< One step a pass, a number of rows at once.
        tiles,    ///< Tiles; around each the steps before the last are computed so far as they are
                  ///< needed.
        windows,  ///< Row by row through all steps: of each but the last only those rows that the
                  ///< next needs.
    };
    Kind kind = Kind::rows;
    int steps = 1;   ///< For each pass, at most HalideProgram::most_steps.
    int width = 0;   ///< Of tiles, or of strips of windows; 0: that of the grid.
    int height = 1;  ///< Of tiles; of kind `rows` the rows at once.

    std::string name() const;
};

/// The pipeline of one system by one schedule, compiled for this processor.
class HalideProgram {
public:
    static constexpr int most_steps = 16;

    HalideProgram(HalideSystem system, const HalideSchedule& schedule);

    const HalideSchedule& schedule() const { return schedule_; }

    /// Takes the schedule's steps from `now` to the cells [0, W) × [0, H) of `next`. Planes have a
    /// halo of most_steps cells, of which a pass reads as many as it has steps.
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
    std::vector<Halide::Func> steps_;  ///< The first is the old step, the last the new one.
    Halide::Target target_;
    Halide::Pipeline pipeline_;
};

/// Planes of a grid that wraps, from the starting values of our side.
class HalideSide {
public:
    /// `varying` names the parameter that varies, or is empty.
    HalideSide(const CascadeSide& like, const std::string& varying);

    /// By a program of the same system; `count` is a multiple of its schedule's steps.
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
