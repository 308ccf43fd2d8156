// cascade_model_times: the time from the file of a model to the first step on its cells, phase by
// phase.
//
// usage: cascade_model_times [--model=FILE] [--threads=N] [CELLS…]   by default 64,000 cells on a
// torus
//
// Prints the wall time and the processor time of each phase, in seconds. On a machine that others
// use, the latter divided by the number of cores is about the wall time on an idle machine. Phases
// are called one by one, as `Simulation::create` does in a run. The last two rows are such a run as
// a whole, including the compilation of its kernels.
#include "core/floating_point.h"
#include "core/parallel.h"
#include "core/processor_time.h"
#include "core/quantities.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "mesh/shapes.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "surface/cell_gradient.h"
#include "surface/cell_order.h"
#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/voronoi_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <vector>

namespace cascade::bench {
namespace {

/// Turk's spots: two species, and a parameter that is random in each cell.
constexpr const char* script_text = "stage s: turing_spots { iterations: 2000; ka: 0.05/16 }\n";

class Stopwatch {
public:
    void row(const std::string& phase) {
        fmt::print("{:<24}{:>9.3f}{:>9.3f}\n", phase, wall() - wall_,
                   processor_seconds() - processors_);
        std::fflush(stdout);
        wall_ = wall();
        processors_ = processor_seconds();
    }

private:
    static double wall() {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::chrono::duration<double>(now).count();
    }
    double wall_ = wall(), processors_ = processor_seconds();
};

[[noreturn]] void refuse(const std::string& why) {
    std::fprintf(stderr, "%s\n", why.c_str());
    std::exit(1);
}

/// Reads a model, or makes a torus if `path` is empty.
SurfaceMesh read(const std::string& path, Stopwatch& watch) {
    if (path.empty()) {
        Result<SurfaceMesh> torus = torus_mesh(1, 0.4, 0.02);
        if (!torus) refuse(torus.error().message);
        watch.row("make the torus");
        return *std::move(torus);
    }
    Result<PolygonSoup> soup = read_model(path);
    if (!soup) refuse(soup.error().message);
    watch.row("read the file");
    Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (!made) refuse(made.error().message);
    watch.row("make a manifold");
    return std::move(made->mesh);
}

LinkList links_of(const SurfaceCells& cells) {
    LinkList list;
    list.ends = cells.ends;
    for (const VoronoiEdge& edge : cells.edges) {
        list.neighbours.push_back(edge.neighbour);
        list.weights.push_back(edge.weight());
    }
    return list;
}

void phases(const std::string& path, std::size_t count, int threads) {
    const std::atomic<bool> cancel = false;
    Team team(threads);
    Stopwatch watch;
    const SurfaceMesh mesh = read(path, watch);
    std::vector<SurfacePlace> places = scatter(mesh, count, 1);
    watch.row("scatter");
    relax(mesh, places, relaxing_rounds, team, cancel);
    watch.row("relax");
    const SurfaceCells cells = voronoi_cells(mesh, std::move(places), team, cancel);
    watch.row("cells");
    LinkList list = links_of(cells);
    const std::vector<std::uint32_t> order = order_for_steps(list);
    watch.row("order");
    const PlaneLayout rows(Grid{512, static_cast<std::int64_t>((count + 511) / 512)});
    const Links links(list, rows, Precision::single, order);
    watch.row("links");
    const std::vector<Vector3d> gradients = cell_gradient_weights(mesh, cells, team, cancel);
    watch.row("weights of gradients");
}

void whole(const std::string& path, std::size_t count, int threads) {
    Stopwatch watch;
    Overrides changes;
    changes.model = path.empty() ? "torus" : std::filesystem::absolute(path).string();
    changes.model_is_asked_for = true;
    changes.cells = std::to_string(count);
    Script script = load_script("bench", script_text, ".", std::move(changes));
    if (!script.program) refuse(script.messages(false));
    SimulationOptions options;
    options.threads = threads;
    auto simulation = Simulation::create(script, options);
    if (!simulation) refuse(simulation.error().message);
    RunControl control;
    if (auto started = (*simulation)->start_stage(0); !started) refuse(started.error().message);
    const auto step = [&](std::int64_t last) {
        auto end = (*simulation)->advance_stage(0, last, control, {});
        if (!end) refuse(end.error().message);
    };
    step(1);
    watch.row("= a run to its first step");
    step(1001);
    // A step is divided if cells are so small that the whole step would not be stable.
    const std::uint32_t parts = std::max(1U, (*simulation)->state(0).time.stages);
    watch.row(fmt::format("1,000 steps of {} parts", parts));
}

void measure(const std::string& path, std::size_t count, int threads) {
    fmt::print("\n{} cells, {} threads\n{:<24}{:>9}{:>9}\n", count, threads, "", "wall", "cores");
    // The whole run comes first, so that its peak of memory is measured.
    whole(path, count, threads);
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    fmt::print("{:<24}{:>18}\n", "memory at most", with_unit(1024.0 * double(used.ru_maxrss), "B"));
    phases(path, count, threads);
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    const cascade::FlushDenormals environment;
    std::string model;
    int threads = cascade::hardware_threads();
    std::vector<std::size_t> counts;
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k];
        constexpr std::string_view of_model = "--model=", of_threads = "--threads=";
        if (word.starts_with(of_model)) {
            model = word.substr(of_model.size());
            continue;
        }
        const bool is_threads = word.starts_with(of_threads);
        const long number = std::atol(argv[k] + (is_threads ? of_threads.size() : 0));
        if (number < 1 || (is_threads && number > 1024)) {
            std::fprintf(stderr,
                         "usage: cascade_model_times [--model=FILE] [--threads=N] [CELLS...]\n");
            return 64;
        }
        if (is_threads) {
            threads = static_cast<int>(number);
        } else {
            counts.push_back(static_cast<std::size_t>(number));
        }
    }
    if (counts.empty()) counts = {64'000};
    for (const std::size_t count : counts) cascade::bench::measure(model, count, threads);
}
