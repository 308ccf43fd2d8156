// cascade_picture_times: how long pictures of surface cells take.
//
// --model=FILE selects a model instead of a torus of 97,000 triangles. All flags of Google
// Benchmark work. Draws 64,000 cells with as many threads as the machine has.
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "run/pictures/cell_picture.h"
#include "surface/blur_cells.h"
#include "surface/relax.h"
#include "surface/scatter.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string_view>

namespace cascade::bench {
namespace {

constexpr std::size_t cell_count = 64'000;

/// A torus whose tube varies in thickness on the way around.
PolygonSoup torus() {
    constexpr std::uint32_t sides = 220;
    PolygonSoup soup;
    for (std::uint32_t j = 0; j < sides; ++j) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double around = 2 * std::numbers::pi * i / sides;
            const double across = 2 * std::numbers::pi * j / sides;
            const double tube = 0.3 + 0.08 * std::sin(5 * around);
            const double radius = 1 + tube * std::cos(across);
            soup.points.push_back(
                {radius * std::cos(around), tube * std::sin(across), -radius * std::sin(around)});
            const auto at = [&](std::uint32_t column, std::uint32_t row) {
                return row % sides * sides + column % sides;
            };
            for (const std::uint32_t corner :
                 {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) {
                soup.corners.push_back(corner);
            }
            soup.ends.push_back(soup.corners.size());
        }
    }
    return soup;
}

/// The model and the cells to draw, made once.
struct Subject {
    Team team{hardware_threads()};
    SurfaceMesh mesh;
    SurfaceCells cells;
    std::vector<float> values, heights;

    explicit Subject(SurfaceMesh surface) : mesh(std::move(surface)) {
        const std::atomic<bool> cancel = false;
        std::vector<SurfacePlace> places = scatter(mesh, cell_count, 1);
        relax(mesh, places, 10, team, cancel);
        cells = voronoi_cells(mesh, std::move(places), team, cancel);
        const MeshFacts facts = facts_of(mesh);
        const double size = length(facts.high - facts.low);
        for (const SurfacePlace& place : cells.places) {
            const Vector3d p = position_of(mesh, place) * (40 / size);
            const double wave = std::sin(p.x) + std::sin(p.y) + std::sin(p.z);
            values.push_back(static_cast<float>(wave));
            heights.push_back(static_cast<float>(0.002 * size * wave));
        }
    }
    PaintedCells look() const {
        return {1, values,
                [](std::span<const float> v, const SurfacePlace&) -> Colour {
                    return v[0] > 0 ? Colour{0.9F, 0.8F, 0.6F} : Colour{0.3F, 0.2F, 0.1F};
                },
                heights};
    }
};

void make_scene(benchmark::State& state, Subject& subject) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(CellScene(subject.mesh, subject.cells, subject.team));
    }
}

/// Arguments are the side of the picture and its quality.
void draw_picture(benchmark::State& state, Subject& subject) {
    CellScene scene(subject.mesh, subject.cells, subject.team);
    const PaintedCells look = subject.look();
    DrawOptions options;
    options.width = options.height = state.range(0);
    options.quality = static_cast<Quality>(state.range(1));
    options.view.up = {0, 1, 0};
    for (auto _ : state) benchmark::DoNotOptimize(scene.draw(look, options, subject.team));
}

/// The picture of a run as a file, including all preparation from its cells.
void whole_picture(benchmark::State& state, Subject& subject) {
    const PaintedCells look = subject.look();
    DrawOptions options;
    options.quality = static_cast<Quality>(state.range(0));
    options.view.up = {0, 1, 0};
    for (auto _ : state) {
        CellScene scene(subject.mesh, subject.cells, subject.team);
        const Image image = scene.draw(look, options, subject.team);
        benchmark::DoNotOptimize(encode_png(image, PngDepth::eight, {}, PngMeaning::colours));
    }
}

void ask_filter(benchmark::State& state, Subject& subject) {
    const CellFilter filter(subject.mesh, subject.cells, subject.team);
    const std::vector<SurfacePlace> places = scatter(subject.mesh, 10'000, 2);
    std::vector<CellShare> shares;
    for (auto _ : state) {
        for (const SurfacePlace& place : places) {
            filter.shares(place, shares);
            benchmark::DoNotOptimize(shares.data());
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}

void blur(benchmark::State& state, Subject& subject) {
    for (auto _ : state) {
        std::vector<float> values = subject.values;
        blur_cells(subject.cells, static_cast<double>(state.range(0)), 1, values, subject.team);
        benchmark::DoNotOptimize(values.data());
    }
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    using namespace cascade;
    PolygonSoup soup;
    constexpr std::string_view option = "--model=";
    if (argc > 1 && std::string_view(argv[1]).starts_with(option)) {
        Result<PolygonSoup> read = read_model(argv[1] + option.size());
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().message.c_str());
            return 1;
        }
        soup = std::move(*read);
        argv[1] = argv[0];
        ++argv;
        --argc;
    } else {
        soup = bench::torus();
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 64;
    Result<MadeMesh> made = make_mesh(std::move(soup));
    if (!made) {
        std::fprintf(stderr, "%s\n", made.error().message.c_str());
        return 1;
    }
    bench::Subject subject(std::move(made->mesh));
    const auto add = [&](const char* name, void (*function)(benchmark::State&, bench::Subject&)) {
        return benchmark::RegisterBenchmark(name,
                                            [function, &subject](benchmark::State& state) {
                                                function(state, subject);
                                            })
            ->MeasureProcessCPUTime()
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    };
    add("scene", bench::make_scene);
    add("draw", bench::draw_picture)->Args({512, 0})->Args({512, 1})->Args({512, 2})->Args({64, 1});
    add("picture", bench::whole_picture)->Arg(0)->Arg(1);
    add("filter", bench::ask_filter);
    add("blur", bench::blur)->Arg(1)->Arg(8);
    benchmark::RunSpecifiedBenchmarks();
}
