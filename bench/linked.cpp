// cascade_linked_bench: Turing's step over linked cells, on one core. Compares native code, run by
// the solver's stepper, with straight C++ over the same slices, and over compressed rows in the
// cells' own order.
//
// These options come first: --order=steps|curve|levels|own, --window=CELLS (0 groups nothing),
// --width=CELLS of a row, --lanes=4|8|16, and --levels=STEPS for each pass through memory (0: as
// many as fit). Flags of Google Benchmark follow.
#include "bench/linked_cells.h"
#include "bench/medians.h"
#include "bench/straight_links.h"
#ifdef CASCADE_BENCH_EIGEN
#include "bench/straight_eigen.h"
#endif
#include "core/floating_point.h"
#include "ir/builder.h"
#include "jit/jit.h"
#include "solvers/stepper.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::bench {
namespace {

constexpr LinkedTuring parameters{1.0f, 0.05f / 16, 0.125f, 0.03125f};
constexpr std::int64_t steps = 16;  // Steps per iteration of a benchmark.

struct Choices {
    std::string order = "steps";
    std::size_t window = 0;
    std::int64_t width = 512;
    int lanes = 0;
    int levels = 0;
};

double start_value(std::size_t cell, int which) {
    return 4 + 0.3 * std::sin(0.01 * static_cast<double>(cell) + which);
}
double beta_value(std::size_t cell) { return 12 + 0.1 * std::sin(static_cast<double>(cell)); }

CellKernel turing_kernel() {
    KernelBuilder b;
    const FieldSlot u_slot = b.field_slot("u"), v_slot = b.field_slot("v");
    const ValueId u = b.field(u_slot), v = b.field(v_slot), uv = b.multiply(u, v);
    const auto uniform = [&](const char* name) { return b.uniform(b.uniform_slot(name)); };
    const ValueId step = uniform("step"), s = uniform("s");
    const ValueId du = uniform("diff_u"), dv = uniform("diff_v");
    const ValueId eaten = b.subtract(b.subtract(uv, v), b.field(b.field_slot("beta")));
    const auto next = [&](ValueId value, ValueId reaction, ValueId diffusion, FieldSlot slot) {
        const ValueId rate =
            b.add(b.multiply(s, reaction), b.multiply(diffusion, b.laplacian(slot)));
        return b.add(value, b.multiply(step, rate));
    };
    b.result("u", next(u, b.subtract(b.number(16), uv), du, u_slot));
    b.result("v", next(v, eaten, dv, v_slot));
    return std::move(b).finish();
}

/// Cells in rows, for native code and for straight C++ over slices.
class Sliced {
public:
    Sliced(const LinkedCells& cells, const Choices& choices, Backend& backend)
        : grid_(grid_of(cells, choices.width)),
          layout_(grid_),
          links_(cells.links, layout_, Precision::single),
          targets_(links_.table<float>().starts[grid_.cell_count() / 16] * 16),
          beta_(plane([](std::size_t cell) { return beta_value(cell); })) {
        const LinkTable<float> table = links_.table<float>();
        for (std::size_t k = 0; k < targets_.bytes() / sizeof(std::int32_t); ++k) {
            const std::int64_t target = table.target(static_cast<std::int64_t>(k));
            targets_.data()[k] = static_cast<std::int32_t>(target);
        }
        for (int which = 0; which < 2; ++which) {
            const auto value = [&](std::size_t cell) { return start_value(cell, which); };
            theirs_.push_back(plane(value));
            theirs_next_.emplace_back(layout_);
            ours_.push_back(Field(plane(value)));
        }
        const auto kernel = backend.compile(turing_kernel(), Stencil::linked);
        if (!kernel) std::abort();
        StepProblem::Pass& pass = problem_.passes.emplace_back();
        using SpeciesPlane = StepProblem::SpeciesPlane;
        pass.kernel = *kernel;
        for (const SpeciesId k : ids_below<SpeciesId>(2)) {
            pass.fields.push_back(SpeciesPlane{k, old_register});
            pass.results.push_back({SpeciesPlane{k, new_register}});
        }
        pass.fields.push_back(&beta_);
        pass.uniforms = {double{parameters.step}, double{parameters.s},
                         double{parameters.diffusion_u}, double{parameters.diffusion_v}};
        problem_.grid = grid_;
        problem_.links = &links_;
        problem_.species_needs_halo.assign(2, true);
        stepper_.emplace(problem_, std::move(ours_), 1);
        if (choices.levels > 0) {
            Tiling tiling = stepper_->executor().tilings_to_try().front();
            tiling.levels = choices.levels;
            tiling.outer_layer = std::max(tiling.outer_layer, rows_reached(problem_));
            stepper_->executor().use_tiling(tiling);
        }
    }

    void advance(std::int64_t count) {
        stepper_->advance(taken_, count, false);
        taken_ += count;
    }
    void advance(decltype(&sliced_by_loads) step, std::int64_t count) {
        const LinkTable<float> table = links_.table<float>();
        const SlicedLinks links{table.starts, targets_.data(), table.weights,
                                grid_.width,  grid_.height,    layout_.stride};
        for (; count > 0; --count) {
            step(parameters, links,
                 {{theirs_[0].origin(), theirs_[1].origin()},
                  {theirs_next_[0].origin(), theirs_next_[1].origin()},
                  beta_.origin()});
            std::swap(theirs_, theirs_next_);
        }
    }
    double ours(std::size_t cell) {
        return (stepper_->species()[0].plane<float>().origin())[place(cell)];
    }
    double theirs(std::size_t cell) const { return theirs_[0].origin()[place(cell)]; }
    /// The number of entries of all slices, with padding, divided by the number of links.
    double filling(const LinkedCells& cells) const {
        const auto slices = static_cast<std::size_t>(grid_.cell_count() / 16);
        return 16.0 * links_.table<float>().starts[slices] /
               static_cast<double>(cells.links.neighbours.size());
    }

private:
    static Grid grid_of(const LinkedCells& cells, std::int64_t width) {
        Grid grid;
        grid.linked = true;
        grid.width = width;
        grid.height = (static_cast<std::int64_t>(cells.positions.size()) + width - 1) / width;
        return grid;
    }
    std::int64_t place(std::size_t cell) const {
        const auto number = static_cast<std::int64_t>(cell);
        return layout_.row_start(number / grid_.width) + number % grid_.width;
    }
    Plane<float> plane(auto value) const {
        Plane<float> plane(layout_);
        for (std::size_t cell = 0; cell < static_cast<std::size_t>(grid_.cell_count()); ++cell) {
            plane.origin()[place(cell)] = static_cast<float>(value(cell));
        }
        return plane;
    }

    Grid grid_;
    PlaneLayout layout_;
    Links links_;
    AlignedArray<std::int32_t> targets_;  ///< Neighbours as 32-bit numbers, for straight C++.
    Field beta_;
    std::vector<Plane<float>> theirs_, theirs_next_;
    std::vector<Field> ours_;
    StepProblem problem_;
    std::optional<Stepper> stepper_;
    std::int64_t taken_ = 0;
};

/// Cells as compressed rows, for straight C++.
class Rows {
public:
    explicit Rows(const LinkedCells& cells)
        : ends_(cells.links.ends.begin(), cells.links.ends.end()),
          targets_(cells.links.neighbours.begin(), cells.links.neighbours.end()),
          weights_(cells.links.weights.begin(), cells.links.weights.end()) {
        for (std::size_t cell = 0; cell < ends_.size(); ++cell) {
            for (int which = 0; which < 2; ++which) {
                now_[which].push_back(static_cast<float>(start_value(cell, which)));
            }
            beta_.push_back(static_cast<float>(beta_value(cell)));
        }
        next_[0] = next_[1] = now_[0];
    }
    RowLinks links() const {
        return {ends_.data(), targets_.data(), weights_.data(),
                static_cast<std::int64_t>(ends_.size())};
    }
    template <typename Step>
    void advance(const Step& step, std::int64_t count) {
        for (; count > 0; --count) {
            step(LinkedPlanes{{now_[0].data(), now_[1].data()},
                              {next_[0].data(), next_[1].data()},
                              beta_.data()});
            std::swap(now_, next_);
        }
    }
    double value(std::size_t cell) const { return now_[0][cell]; }

private:
    std::vector<std::uint32_t> ends_;
    std::vector<std::int32_t> targets_;
    std::vector<float> weights_, beta_;
    std::vector<float> now_[2], next_[2];
};

struct Contest {
    Contest(std::size_t side, const Choices& choices, Backend& backend)
        : cells(cells_of_torus(side)),
          ordered(in_order(cells, choices.order, choices.window)),
          sliced(ordered, choices, backend),
          rows(cells),
          ordered_rows(ordered)
#ifdef CASCADE_BENCH_EIGEN
          ,
          eigen(rows.links())
#endif
    {
    }
    LinkedCells cells, ordered;
    Sliced sliced;
    Rows rows, ordered_rows;
#ifdef CASCADE_BENCH_EIGEN
    EigenLinks eigen;
#endif
};

using Advance = void (*)(Contest&);
const std::vector<std::pair<std::string, Advance>> contestants{
    {"jit", [](Contest& c) { c.sliced.advance(steps); }},
    {"gathers", [](Contest& c) { c.sliced.advance(sliced_by_gathers, steps); }},
    {"loads", [](Contest& c) { c.sliced.advance(sliced_by_loads, steps); }},
    {"rows in our order",
     [](Contest& c) {
         c.ordered_rows.advance(
             [&](const auto& p) { by_rows(parameters, c.ordered_rows.links(), p); }, steps);
     }},
    {"rows",
     [](Contest& c) {
         c.rows.advance([&](const auto& p) { by_rows(parameters, c.rows.links(), p); }, steps);
     }},
#ifdef CASCADE_BENCH_EIGEN
    {"Eigen",
     [](Contest& c) {
         c.rows.advance([&](const auto& p) { c.eigen.step(parameters, p); }, steps);
     }},
#endif
};

/// Ends the program if the sides compute different values, because then the comparison would be
/// worthless.
void check_agreement(const Choices& choices, Backend& backend) {
    Contest contest(64, choices, backend);
    contest.sliced.advance(100);
    contest.ordered_rows.advance(
        [&](const auto& p) { by_rows(parameters, contest.ordered_rows.links(), p); }, 100);
    contest.sliced.advance(sliced_by_gathers, 50);
    contest.sliced.advance(sliced_by_loads, 50);
    for (std::size_t cell = 0; cell < 64 * 64; ++cell) {
        const double expected = contest.ordered_rows.value(cell);
        const double worst = std::max(std::abs(contest.sliced.ours(cell) - expected),
                                      std::abs(contest.sliced.theirs(cell) - expected));
        if (worst < 1e-4) continue;
        fmt::print(stderr, "cascade_linked_bench: cell {} differs by {}\n", cell, worst);
        std::exit(1);
    }
}

int run(int argc, char** argv) {
    const FlushDenormals environment;
    Choices choices;
    for (; argc > 1; ++argv, --argc) {
        const std::string_view word(argv[1]);
        const auto number = [&] { return std::atoi(argv[1] + word.find('=') + 1); };
        if (word.starts_with("--order=")) {
            choices.order = word.substr(word.find('=') + 1);
        } else if (word.starts_with("--window=")) {
            choices.window = static_cast<std::size_t>(std::max(number(), 0));
        } else if (word.starts_with("--width=")) {
            choices.width = number();
        } else if (word.starts_with("--levels=")) {
            choices.levels = number();
        } else if (word.starts_with("--lanes=")) {
            choices.lanes = number();
        } else {
            break;
        }
        argv[1] = argv[0];
    }
    auto backend = make_jit({choices.lanes, 2});
    if (!backend || choices.width < 16 || choices.width % 16 != 0) return 64;
    check_agreement(choices, **backend);

    if (!initialize_benchmarks(argc, argv)) return 64;

    std::map<std::size_t, std::unique_ptr<Contest>> contests;
    for (const std::size_t side : {256, 1024}) {
        for (const auto& contestant : contestants) {
            benchmark::RegisterBenchmark(
                fmt::format("{}/{}", side * side, contestant.first).c_str(),
                [&, side, advance = contestant.second](benchmark::State& state) {
                    auto& contest = contests[side];
                    if (!contest) {
                        contest = std::make_unique<Contest>(side, choices, **backend);
                    }
                    for (auto _ : state) advance(*contest);
                });
        }
    }
    Medians times;
    benchmark::RunSpecifiedBenchmarks(&times);
    fmt::print("order {}, windows of {}, rows of {}\n{:>9}  {:<18}{:>12}{:>9}{:>16}{:>16}\n",
               choices.order, choices.window, choices.width, "cells", "", "ns a cell", "least",
               "time over ours", "by the least");
    for (const auto& [side, contest] : contests) {
        const auto name = [cells = side * side](const std::string& who) {
            return fmt::format("{}/{}", cells, who);
        };
        const double cell_steps = static_cast<double>(side * side) * steps;
        for (const auto& contestant : contestants) {
            const double median = times.median(name(contestant.first));
            const double least = times.least(name(contestant.first));
            if (median <= 0) continue;
            fmt::print("{:>9}  {:<18}{:>12.2f}{:>9.2f}{:>16.2f}{:>16.2f}\n", side * side,
                       contestant.first, median / cell_steps * 1e9, least / cell_steps * 1e9,
                       median / times.median(name("jit")), least / times.least(name("jit")));
        }
        fmt::print("{:>9}  entries of slices over links: {:.3f}\n", side * side,
                   contest->sliced.filling(contest->ordered));
    }
    return 0;
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) { return cascade::bench::run(argc, argv); }
