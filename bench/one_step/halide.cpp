// Steps of Gray and Scott's reaction in Halide, with two schedules (docs/one_step.md).
//
//   halide rows|tiles SIDE STEPS [FILE]
//
// takes STEPS steps on SIDE × SIDE cells on one thread, prints the seconds of processor time that
// they took (without compiling), and writes v to FILE.
#include <Halide.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace Halide;

constexpr double pi = 3.14159265358979323846;
constexpr int steps_a_tile = 8;
const Var x("x"), y("y"), tile_x("tile_x"), tile_y("tile_y"), in_x("in_x"), in_y("in_y");

// lines: Halide, the step
Func step_after(const Func& old) {
    const auto lap = [&](int species) {
        return old(x - 1, y)[species] + old(x + 1, y)[species] + old(x, y - 1)[species] +
               old(x, y + 1)[species] - 4 * old(x, y)[species];
    };
    const Expr u = old(x, y)[0], v = old(x, y)[1], rate = u * v * v;
    Func next("step");
    next(x, y) = Tuple(u + 0.16F * lap(0) - rate + 0.037F * (1 - u),
                       v + 0.08F * lap(1) + rate - (0.037F + 0.060F) * v);
    return next;
}
// end

// lines: Halide, row by row
void order_by_rows(const std::vector<Func>& steps) {
    Func(steps.back()).vectorize(x, 16).unroll(y, 2);
}
// end

// lines: Halide, eight steps a tile
void order_by_tiles(const std::vector<Func>& steps) {
    Func last = steps.back();
    last.tile(x, y, tile_x, tile_y, in_x, in_y, 256, 64).vectorize(in_x, 16);
    for (std::size_t k = 0; k + 1 < steps.size(); ++k)
        Func(steps[k]).compute_at(last, tile_x).vectorize(x, 16, TailStrategy::ShiftInwards);
}
// end

/// A plane with `border` cells around it.
Buffer<float> plane_of(int side, int border) {
    Buffer<float> plane(side + 2 * border, side + 2 * border);
    plane.set_min(-border, -border);
    return plane;
}

/// Copies the cells at each side to the border beyond the opposite side.
void fill_border(Buffer<float>& plane, int side, int border) {
    for (int k = 0; k < side; ++k) {
        std::copy_n(&plane(side - border, k), border, &plane(-border, k));
        std::copy_n(&plane(0, k), border, &plane(side, k));
    }
    for (int k = 0; k < border; ++k) {
        std::copy_n(&plane(-border, side - border + k), plane.width(), &plane(-border, k - border));
        std::copy_n(&plane(-border, k), plane.width(), &plane(-border, side + k));
    }
}

Buffer<float> without_border(Buffer<float>& plane, int side) {
    return Buffer<float>(plane.get()->cropped(0, 0, side).cropped(1, 0, side));
}

double start_v(int side, int i, int k) {
    const double at_x = (i + 0.5) / side, at_y = (k + 0.5) / side;
    return 0.2 + 0.1 * std::cos(10 * pi * at_x) * std::cos(6 * pi * at_y) +
           0.05 * std::cos(4 * pi * at_x) * std::cos(14 * pi * at_y);
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fputs("halide rows|tiles SIDE STEPS [FILE]\n", stderr);
        return 64;
    }
    const bool is_tiled = std::string(words[1]) == "tiles";
    const int side = std::atoi(words[2]), steps = std::atoi(words[3]);
    const int border = is_tiled ? steps_a_tile : 1;  // Each step in a tile needs one more cell.
    Buffer<float> u = plane_of(side, border), v = plane_of(side, border);
    Buffer<float> next_u = plane_of(side, border), next_v = plane_of(side, border);
    for (int k = 0; k < side; ++k) {
        for (int i = 0; i < side; ++i) {
            v(i, k) = static_cast<float>(start_v(side, i, k));
            u(i, k) = 1 - v(i, k);
        }
    }

    ImageParam now_u(Float(32), 2), now_v(Float(32), 2);
    Func start("start");
    start(x, y) = Tuple(now_u(x, y), now_v(x, y));
    std::vector<Func> stages;
    for (int step = 0; step < border; ++step)
        stages.push_back(step_after(stages.empty() ? start : stages.back()));
    (is_tiled ? order_by_tiles : order_by_rows)(stages);
    Pipeline pipeline(stages.back());
    pipeline.compile_jit();

    const std::clock_t begin = std::clock();
    for (int step = 0; step < steps; step += border) {
        fill_border(u, side, border);
        fill_border(v, side, border);
        now_u.set(u);
        now_v.set(v);
        Buffer<float> to_u = without_border(next_u, side), to_v = without_border(next_v, side);
        pipeline.realize(Realization(to_u, to_v));
        std::swap(u, next_u);
        std::swap(v, next_v);
    }
    std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (count <= 4) return 0;
    std::ofstream out(words[4], std::ios::binary);
    for (int k = 0; k < side; ++k)
        out.write(reinterpret_cast<const char*>(&v(0, k)),
                  static_cast<std::streamsize>(side * sizeof(float)));
    return out ? 0 : 1;
}
