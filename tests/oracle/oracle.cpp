// The oracle: loops over cells that follow the listings line by line.
#include "tests/oracle/oracle.h"

#include <array>

namespace cascade::oracle {

namespace {

/// The neighbours of every cell: two on a line, four on a plane.
class Neighbours {
public:
    explicit Neighbours(const Surface& surface) : of_(surface.cells()) {
        const std::size_t width = surface.width;
        for (std::size_t cell = 0; cell < surface.cells(); ++cell) {
            const std::size_t i = cell % width;
            const std::size_t j = cell / width;
            for (const bool forth : {false, true}) {
                if (width > 1) of_[cell].push_back(j * width + beside(i, forth, width, surface));
                if (surface.height > 1) {
                    of_[cell].push_back(beside(j, forth, surface.height, surface) * width + i);
                }
            }
        }
    }

    double sum(const Values& values, std::size_t cell) const {
        double total = 0;
        for (const std::size_t other : of_[cell]) total += values[other];
        return total;
    }
    /// The number of neighbours, 4 in the listings.
    double count() const { return static_cast<double>(of_[0].size()); }

private:
    static std::size_t beside(std::size_t at, bool forth, std::size_t size,
                              const Surface& surface) {
        if (forth) return at + 1 < size ? at + 1 : (surface.periodic ? 0 : at);
        return at > 0 ? at - 1 : (surface.periodic ? size - 1 : at);
    }

    std::vector<std::vector<std::size_t>> of_;
};

/// Adds speed · delta to every chemical of every cell that is not frozen. `deltas` returns the
/// delta of each chemical of a cell, in the order of their names. All cells change at the same
/// time.
template <std::size_t count, typename Deltas>
void take_step(State& state, const std::array<const char*, count>& chemicals,
               const Deltas& deltas) {
    const Values& frozen = state.at("frozen");
    const Values& speed = state.at("speed");
    std::array<Values, count> next;
    for (std::size_t k = 0; k < count; ++k) next[k] = state.at(chemicals[k]);
    for (std::size_t cell = 0; cell < frozen.size(); ++cell) {
        if (frozen[cell] != 0) continue;
        const std::array<double, count> delta = deltas(cell);
        for (std::size_t k = 0; k < count; ++k) next[k][cell] += speed[cell] * delta[k];
    }
    for (std::size_t k = 0; k < count; ++k) state.at(chemicals[k]) = next[k];
}

}  // namespace

void turing_spots(const Surface& surface, State& state, int steps) {
    const Neighbours around(surface);
    const Values &a = state.at("a"), &ka = state.at("ka"), &beta = state.at("beta");
    const Values &diff_a = state.at("diff_a"), &diff_b = state.at("diff_b");
    const Values& frozen = state.at("frozen");
    Values& b = state.at("b");
    const auto deltas = [&](std::size_t at) -> std::array<double, 2> {
        const double laplace_a = around.sum(a, at) - around.count() * a[at];
        const double laplace_b = around.sum(b, at) - around.count() * b[at];
        return {ka[at] * (16 - a[at] * b[at]) + diff_a[at] * laplace_a,
                ka[at] * (a[at] * b[at] - b[at] - beta[at]) + diff_b[at] * laplace_b};
    };
    for (int step = 0; step < steps; ++step) {
        take_step<2>(state, {"a", "b"}, deltas);
        for (std::size_t at = 0; at < surface.cells(); ++at) {
            if (frozen[at] == 0 && b[at] < 0) b[at] = 0;
        }
    }
}

void autocatalysis(const Surface& surface, State& state, int steps) {
    const Neighbours around(surface);
    const Values &a = state.at("a"), &b = state.at("b"), &ai = state.at("ai"), &s = state.at("s");
    const Values &p1 = state.at("p1"), &p2 = state.at("p2"), &p3 = state.at("p3");
    const Values &diff1 = state.at("diff1"), &diff2 = state.at("diff2");
    const auto deltas = [&](std::size_t at) -> std::array<double, 2> {
        const double ka = -s[at] * p1[at] - around.count() * diff1[at];
        const double kb = -s[at] * p2[at] - around.count() * diff2[at];
        const double temp = 0.01 * ai[at] * a[at] * a[at];
        return {a[at] * ka + diff1[at] * around.sum(a, at) + s[at] * (temp / b[at] + p3[at]),
                b[at] * kb + diff2[at] * around.sum(b, at) + s[at] * temp};
    };
    for (int step = 0; step < steps; ++step) take_step<2>(state, {"a", "b"}, deltas);
}

void stripes(const Surface& surface, State& state, int steps) {
    const Neighbours around(surface);
    const Values &a = state.at("a"), &b = state.at("b"), &c = state.at("c"), &d = state.at("d");
    const Values &e = state.at("e"), &ai = state.at("ai");
    const Values &p1 = state.at("p1"), &p2 = state.at("p2"), &p3 = state.at("p3");
    const Values &diff1 = state.at("diff1"), &diff2 = state.at("diff2");
    const auto deltas = [&](std::size_t at) -> std::array<double, 5> {
        const double ka = -p1[at] - around.count() * diff1[at];
        const double kc = -p2[at];
        const double kd = -p3[at] - around.count() * diff2[at];
        const double temp1 = 0.01 * a[at] * a[at] * e[at] * ai[at];
        const double temp2 = 0.01 * b[at] * b[at] * d[at];
        return {a[at] * ka + diff1[at] * around.sum(a, at) + temp1 / c[at],
                b[at] * ka + diff1[at] * around.sum(b, at) + temp2 / c[at],
                c[at] * kc + temp1 + temp2,
                d[at] * kd + diff2[at] * around.sum(d, at) + p3[at] * a[at],
                e[at] * kd + diff2[at] * around.sum(e, at) + p3[at] * b[at]};
    };
    for (int step = 0; step < steps; ++step) {
        take_step<5>(state, {"a", "b", "c", "d", "e"}, deltas);
    }
}

void gray_scott(const Surface& surface, State& state, int steps) {
    const Neighbours around(surface);
    const Values &u = state.at("u"), &v = state.at("v");
    const Values &feed = state.at("feed"), &kill = state.at("kill");
    const Values &diff_u = state.at("diff_u"), &diff_v = state.at("diff_v");
    const auto deltas = [&](std::size_t at) -> std::array<double, 2> {
        const double reaction = u[at] * v[at] * v[at];
        const double laplace_u = around.sum(u, at) - around.count() * u[at];
        const double laplace_v = around.sum(v, at) - around.count() * v[at];
        return {diff_u[at] * laplace_u - reaction + feed[at] * (1 - u[at]),
                diff_v[at] * laplace_v + reaction - (feed[at] + kill[at]) * v[at]};
    };
    for (int step = 0; step < steps; ++step) take_step<2>(state, {"u", "v"}, deltas);
}

}  // namespace cascade::oracle
