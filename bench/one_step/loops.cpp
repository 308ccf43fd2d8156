// Steps of Gray and Scott's reaction in C++: first as they are written without thought, then faster
// change by change (docs/one_step.md).
//
//   loops VARIANT SIDE STEPS [FILE]
//
// takes STEPS steps on SIDE × SIDE cells, prints the seconds of processor time that they took, and
// writes v to FILE in single precision.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double diff_u = 0.16, diff_v = 0.08, feed = 0.037, kill = 0.060;

/// The starting value of v in column i and row k.
double start_v(int side, int i, int k) {
    const double x = (i + 0.5) / side, y = (k + 0.5) / side;
    return 0.2 + 0.1 * std::cos(10 * pi * x) * std::cos(6 * pi * y) +
           0.05 * std::cos(4 * pi * x) * std::cos(14 * pi * y);
}

/// Two species, before and after the step, in planes with `border` further cells on every side.
template <typename Number>
struct Planes {
    Planes(int cells, int border_cells)
        : side(cells), border(border_cells), stride(cells + 2 * border_cells) {
        for (auto* plane : {&u, &v, &next_u, &next_v})
            plane->resize(static_cast<std::size_t>(stride) * stride);
        for (int k = 0; k < side; ++k) {
            for (int i = 0; i < side; ++i) {
                v[at(i, k)] = static_cast<Number>(start_v(side, i, k));
                u[at(i, k)] = 1 - v[at(i, k)];
            }
        }
    }
    std::size_t at(int i, int k) const {
        return static_cast<std::size_t>(k + border) * stride + i + border;
    }
    void swap() {
        u.swap(next_u);
        v.swap(next_v);
    }
    int side, border, stride;
    std::vector<Number> u, v, next_u, next_v;
};

// lines: C++, remainders
template <typename Number>
void step_by_remainders(Planes<Number>& p) {
    const int n = p.side;
    for (int k = 0; k < n; ++k) {
        for (int i = 0; i < n; ++i) {
            const int left = k * n + (i + n - 1) % n, right = k * n + (i + 1) % n;
            const int above = (k + n - 1) % n * n + i, below = (k + 1) % n * n + i;
            const int c = k * n + i;
            const Number u = p.u[c], v = p.v[c], rate = u * v * v;
            const Number lap_u = p.u[left] + p.u[right] + p.u[above] + p.u[below] - 4 * u;
            const Number lap_v = p.v[left] + p.v[right] + p.v[above] + p.v[below] - 4 * v;
            p.next_u[c] = u + Number(diff_u) * lap_u - rate + Number(feed) * (1 - u);
            p.next_v[c] = v + Number(diff_v) * lap_v + rate - Number(feed + kill) * v;
        }
    }
    p.swap();
}
// end

// lines: C++, border cells
/// Copies the cells at each side to the border beyond the opposite side.
template <typename Number>
void fill_border(Planes<Number>& p, int width) {
    for (auto* plane : {&p.u, &p.v}) {
        Number* cells = plane->data();
        for (int k = 0; k < p.side; ++k) {
            std::copy_n(cells + p.at(p.side - width, k), width, cells + p.at(-width, k));
            std::copy_n(cells + p.at(0, k), width, cells + p.at(p.side, k));
        }
        const int row = p.side + 2 * width;
        for (int k = 0; k < width; ++k) {
            std::copy_n(cells + p.at(-width, p.side - width + k), row,
                        cells + p.at(-width, k - width));
            std::copy_n(cells + p.at(-width, k), row, cells + p.at(-width, p.side + k));
        }
    }
}

/// New values of the cells [from, to) of a row.
template <typename Number>
void step_row(const Number* __restrict u, const Number* __restrict v, Number* __restrict next_u,
              Number* __restrict next_v, int stride, int from, int to) {
    for (int i = from; i < to; ++i) {
        const Number rate = u[i] * v[i] * v[i];
        const Number lap_u = u[i - 1] + u[i + 1] + u[i - stride] + u[i + stride] - 4 * u[i];
        const Number lap_v = v[i - 1] + v[i + 1] + v[i - stride] + v[i + stride] - 4 * v[i];
        next_u[i] = u[i] + Number(diff_u) * lap_u - rate + Number(feed) * (1 - u[i]);
        next_v[i] = v[i] + Number(diff_v) * lap_v + rate - Number(feed + kill) * v[i];
    }
}

template <typename Number>
void step_with_border(Planes<Number>& p) {
    fill_border(p, 1);
    for (int k = 0; k < p.side; ++k) {
        const std::size_t row = p.at(0, k);
        step_row(&p.u[row], &p.v[row], &p.next_u[row], &p.next_v[row], p.stride, 0, p.side);
    }
    p.swap();
}
// end

// lines: C++, eight steps a tile
constexpr int steps_a_tile = 8, tile_width = 256, tile_height = 64;

/// Takes eight steps in one tile after the other. A tile is copied with the eight cells around it,
/// and each step computes one cell less on every side.
void eight_steps(Planes<float>& p) {
    constexpr int stride = tile_width + 2 * steps_a_tile, rows = tile_height + 2 * steps_a_tile;
    static std::vector<float> u(stride * rows), v(stride * rows), next_u(stride * rows),
        next_v(stride * rows);
    fill_border(p, steps_a_tile);
    for (int top = 0; top < p.side; top += tile_height) {
        for (int left = 0; left < p.side; left += tile_width) {
            const int width = std::min(tile_width, p.side - left) + 2 * steps_a_tile;
            const int height = std::min(tile_height, p.side - top) + 2 * steps_a_tile;
            for (int k = 0; k < height; ++k) {
                const std::size_t row = p.at(left - steps_a_tile, top - steps_a_tile + k);
                std::copy_n(&p.u[row], width, &u[k * stride]);
                std::copy_n(&p.v[row], width, &v[k * stride]);
            }
            for (int step = 1; step < steps_a_tile; ++step) {
                for (int k = step; k < height - step; ++k) {
                    const int row = k * stride;
                    step_row(&u[row], &v[row], &next_u[row], &next_v[row], stride, step,
                             width - step);
                }
                u.swap(next_u);
                v.swap(next_v);
            }
            for (int k = steps_a_tile; k < height - steps_a_tile; ++k) {
                const int row = k * stride + steps_a_tile;
                const std::size_t to = p.at(left, top - steps_a_tile + k);
                step_row(&u[row], &v[row], &p.next_u[to], &p.next_v[to], stride, 0,
                         width - 2 * steps_a_tile);
            }
        }
    }
    p.swap();
}
// end

template <typename Number, typename Advance>
int run(int side, int border, int steps, const char* file, Advance advance) {
    Planes<Number> planes(side, border);
    const std::clock_t begin = std::clock();
    advance(planes, steps);
    std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (file == nullptr) return 0;
    std::FILE* out = std::fopen(file, "wb");
    if (out == nullptr) return 1;
    for (int k = 0; k < side; ++k) {
        for (int i = 0; i < side; ++i) {
            const auto value = static_cast<float>(planes.v[planes.at(i, k)]);
            std::fwrite(&value, sizeof value, 1, out);
        }
    }
    return std::fclose(out) == 0 ? 0 : 1;
}

template <typename Number>
void by_remainders(Planes<Number>& planes, int steps) {
    for (int step = 0; step < steps; ++step) step_by_remainders(planes);
}

template <typename Number>
void with_border(Planes<Number>& planes, int steps) {
    for (int step = 0; step < steps; ++step) step_with_border(planes);
}

void in_tiles(Planes<float>& planes, int steps) {
    for (int step = 0; step < steps; step += steps_a_tile) eight_steps(planes);
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fputs("loops VARIANT SIDE STEPS [FILE]\n", stderr);
        return 64;
    }
    const std::string variant = words[1];
    const int side = std::atoi(words[2]), steps = std::atoi(words[3]);
    const char* file = count > 4 ? words[4] : nullptr;
    if (variant == "remainders-double")
        return run<double>(side, 0, steps, file, by_remainders<double>);
    if (variant == "remainders") return run<float>(side, 0, steps, file, by_remainders<float>);
    if (variant == "border-double") return run<double>(side, 1, steps, file, with_border<double>);
    if (variant == "border") return run<float>(side, 1, steps, file, with_border<float>);
    if (variant == "tiles") return run<float>(side, steps_a_tile, steps, file, in_tiles);
    std::fprintf(stderr, "loops: there is no variant %s\n", words[1]);
    return 64;
}
