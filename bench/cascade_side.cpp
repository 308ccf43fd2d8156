// Cascade's side of the benchmarks.
#include "bench/cascade_side.h"

#include "run/stage/bound_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>

namespace cascade::bench {
namespace {

[[noreturn]] void give_up(const std::string& why) {
    std::fprintf(stderr, "cascade_bench: %s\n", why.c_str());
    std::exit(1);
}

template <typename T>
T must(Result<T> result) {
    if (!result) give_up(result.error().message);
    return std::move(*result);
}

std::string domain(const GridSize& grid) {
    const std::string slices = grid.depth > 1 ? fmt::format(", {}", grid.depth) : "";
    return fmt::format("domain {{ grid: {}, {}{}; boundary: periodic; seed: 1 }}\n", grid.width,
                       grid.height, slices);
}

Overrides overrides_for(Rounding rounding) {
    Overrides overrides;
    overrides.fast = rounding == Rounding::fast;
    return overrides;
}

}  // namespace

std::string turing_text(const GridSize& grid) {
    return domain(grid) + R"(stage spots: turing_spots {
  iterations: 1000000
  frozen: disc(0.3, 0.4, 0.2)
  beta: random(12, 0.1)
}
)";
}

std::string gray_scott_text(const GridSize& grid) {
    return domain(grid) + R"(system gray_scott {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.1)
  v: 0.25 * disc(0.5, 0.5, 0.1) + random(0.01, 0.01)
  feed: 0.037
  kill: 0.060
  diff_u: 0.12
  diff_v: 0.06
  rate = u * v^2
  u' = diff_u * lap(u) - rate + feed * (1 - u)
  v' = diff_v * lap(v) + rate - (feed + kill) * v
}
stage only: gray_scott { iterations: 1000000 }
)";
}

std::string stripes_text(const GridSize& grid) {
    return domain(grid) + "stage only: stripes { iterations: 1000000 }\n";
}

std::string cahn_hilliard_text(const GridSize& grid) {
    return domain(grid) + R"(system mixing {
  c: random(0, 0.1)
  gamma: 0.5
  mu = c^3 - c - gamma * lap(c)
  c' = lap(mu)
}
stage only: mixing { iterations: 1000000; speed: 0.02 }
)";
}

std::string chemotaxis_text(const GridSize& grid) {
    return domain(grid) + R"(system swarm {
  cells: random(1, 0.01)
  bait: 1
  chi: 5
  spread: 10
  cells' = lap(cells) - div(chi * cells * grad(bait))
  bait' = spread * lap(bait) + cells / (1 + cells) - bait
}
stage only: swarm { iterations: 1000000; speed: 0.02 }
)";
}

std::string tensor_text(const GridSize& grid) {
    return domain(grid) + R"(system smear {
  c: random(0, 1)
  a1: 1
  a2: 0.3
  theta: 0.6
  c' = div(tensor(a1, a2, theta) * grad(c))
}
stage only: smear { iterations: 1000000; speed: 0.1 }
)";
}

std::string allen_cahn_text(const GridSize& grid) {
    return domain(grid) + "stage only: allen_cahn { iterations: 1000000 }\n";
}

std::string rock_scissors_paper_text(const GridSize& grid) {
    return domain(grid) + "stage only: rock_scissors_paper { iterations: 1000000 }\n";
}

std::string perona_malik_text(const GridSize& grid) {
    return domain(grid) + "stage only: perona_malik { iterations: 1000000 }\n";
}

CascadeSide::CascadeSide(const std::string& text, Backend& backend, Rounding rounding)
    : script_(load_script("bench", text, ".", overrides_for(rounding))) {
    if (!script_.program) give_up(script_.messages(false));
    SimulationOptions options;
    options.backend = "interp";  // The interpreter computes only the starting values.
    options.threads = 1;
    simulation_ = must(Simulation::create(script_, options));
    if (auto started = simulation_->start_stage(0); !started) give_up(started.error().message);

    const StageState& state = simulation_->state(0);
    const BindingContext context{{&state, 1}, files_, 0, simulation_->domain().grid};
    const auto compile = [&](const CellKernel& kernel) {
        return must(backend.compile(kernel, grid().stencil()));
    };
    problem_ = bind_plan(plan_step(*script_.program, 0), compile, context,
                         script_.program->system_of(0), 0);
    stepper_.emplace(problem_, start_species(), 1);
}

std::vector<Field> CascadeSide::start_species() const {
    std::vector<Field> species;
    for (const Field& field : start().species()) species.push_back(field.clone());
    return species;
}

Stepper CascadeSide::fresh_stepper() const { return Stepper(problem_, start_species(), 1); }

void CascadeSide::advance(std::int64_t count) {
    if (!stepper_->advance(steps_, count, true)) give_up("a value is not finite");
    stepper_->keep();
    steps_ += count;
}

const Field& CascadeSide::parameter(const std::string& name) const {
    const System& system = script_.program->system_of(0);
    for (const ItemId item : system.quantities.ids()) {
        if (system.quantities[item].name == name) return start().field(item);
    }
    give_up("no parameter '" + name + "'");
}

std::int64_t cell_count(const GridSize& grid) { return grid.width * grid.height * grid.depth; }

std::int64_t steps_between_looks(const GridSize& grid) {
    return cell_count(grid) > std::int64_t{1} << 22 ? 16 : 64;
}

double largest_difference(std::span<const Field> a, std::span<const Field> b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        for (std::int64_t row = 0; row < a[k].layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < a[k].layout().width; ++i) {
                const double difference = std::abs(double{a[k].row(row)[i]} - b[k].row(row)[i]);
                largest = std::max(largest, std::isnan(difference) ? INFINITY : difference);
            }
        }
    }
    return largest;
}

}  // namespace cascade::bench
