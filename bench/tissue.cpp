// cascade_tissue_bench: 100,000 cells on a torus, on one core. Measures the time to find their
// neighbours, to order them in memory, to compute what they sense, and to compute their rates
// (collision, adhesion, combing) by native code and by a scalar loop in C++. Also measures a tissue
// that grows (tissue_growth.cpp).
#include "bench/straight_tissue.h"
#include "core/floating_point.h"
#include "ir/expression.h"
#include "jit/jit.h"
#include "mesh/shapes.h"
#include "tissue/founders.h"
#include "tissue/neighbours.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

namespace cascade::bench {
namespace {

constexpr std::size_t cells = 100'000, species = 7, results = 6;

/// Cells of equal radii whose discs would cover the torus 1.8 times, so that randomly placed cells
/// have about 14 neighbours.
class Scene {
public:
    Scene() : mesh(*torus_mesh(0.35, 0.15, 0.01)), around(around_surface(mesh)), team(1) {
        const double radius =
            std::sqrt(1.8 * mesh.total_area() / (std::numbers::pi * static_cast<double>(cells)));
        const auto founders = *random_founders(*around, cells, 1, 0);
        TissueRecord record;
        record.species.resize(species);
        for (const NearPlace& founder : founders) {
            const Vector3d axis = unit(cross(founder.normal, Vector3d{0, 1, 0.3}));
            const Vector3d p = founder.position;
            const std::array values{p.x, p.y, p.z, radius, axis.x, axis.y, axis.z};
            for (std::size_t k = 0; k < species; ++k) record.species[k].push_back(values[k]);
            record.triangles.push_back(founder.place.triangle);
            record.numbers.push_back(static_cast<std::uint32_t>(record.numbers.size()));
        }
        tissue = std::make_unique<Tissue>(record, Precision::single);
        look();
        const std::vector<std::uint32_t> order = order_along_curve(seen());
        tissue->rearrange(order);
        look();
        lists = *find_neighbours(seen(), {}, 0.15, 1e9, team);
        links.assign({lists.ends, lists.neighbours}, tissue->layout(), Precision::single);
        for (std::size_t k = 0; k < results; ++k) rates.emplace_back(tissue->layout());
    }

    CellPlaces seen() const { return {places, radii, tissue->ranks()}; }

    SurfaceMesh mesh;
    std::shared_ptr<const Surroundings> around;
    Team team;
    std::unique_ptr<Tissue> tissue;
    std::vector<Vector3d> places;
    std::vector<double> radii;
    NeighbourLists lists;
    Links links;
    std::vector<Plane<float>> rates;

private:
    void look() {
        places.clear();
        radii.clear();
        for (std::size_t k = 0; k < cells; ++k) {
            places.push_back({tissue->value(0, k), tissue->value(1, k), tissue->value(2, k)});
            radii.push_back(tissue->value(3, k));
        }
    }
};

Scene& scene() {
    static Scene made;
    return made;
}

void count_cells(benchmark::State& state) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
}

void neighbours(benchmark::State& state) {
    Scene& s = scene();
    for (auto unused : state) {
        benchmark::DoNotOptimize(find_neighbours(s.seen(), {}, 0.15, 1e9, s.team));
    }
    state.counters["links a cell"] =
        static_cast<double>(s.lists.neighbours.size()) / static_cast<double>(cells);
    count_cells(state);
}

void table_of_links(benchmark::State& state) {
    Scene& s = scene();
    for (auto unused : state) {
        s.links.assign({s.lists.ends, s.lists.neighbours}, s.tissue->layout(), Precision::single);
    }
    count_cells(state);
}

void order(benchmark::State& state) {
    for (auto unused : state) benchmark::DoNotOptimize(order_along_curve(scene().seen()));
    count_cells(state);
}

std::vector<const float*> fields_of(const Scene& s) {
    std::vector<const float*> fields;
    for (const Field& field : s.tissue->species) fields.push_back(field.origin());
    return fields;
}

void sense(benchmark::State& state) {
    Scene& s = scene();
    auto triangles = std::make_shared<NearTriangles>();
    triangles->before = triangles->now = s.tissue->triangles;
    const KernelPointer kernel = make_sense_kernel(s.around,
                                                   {{Sense::Kind::off},
                                                    {Sense::Kind::normal_x},
                                                    {Sense::Kind::normal_y},
                                                    {Sense::Kind::normal_z}},
                                                   triangles);
    const std::vector<const float*> fields = fields_of(s);
    std::vector<float*> planes;
    for (std::size_t k = 0; k < 4; ++k) planes.push_back(s.rates[k].origin());
    const PlaneLayout layout = s.tissue->layout();
    for (auto unused : state) {
        kernel->run(KernelArguments{fields, {}, {}, planes, layout}, {{0, layout.height}});
    }
    count_cells(state);
}

CellKernel rates_kernel() {
    KernelBuilder b;
    const std::array<const char*, species> names{"x", "y", "z", "r", "ax", "ay", "az"};
    std::vector<Expression> own, theirs;
    for (const char* const name : names) {
        const FieldSlot slot = b.field_slot(name);
        own.emplace_back(b, b.field(slot));
        theirs.emplace_back(b, b.theirs(slot));
    }
    const Expression dx = theirs[0] - own[0], dy = theirs[1] - own[1], dz = theirs[2] - own[2];
    const Expression distance = (dx * dx + dy * dy + dz * dz).unary(Op::square_root);
    const Expression both = own[3] + theirs[3], gap = distance - both;
    const Expression touches = distance < both * double{bench_reach};
    const Expression stiffness =
        (gap < 0.0).choose(own[0].number(double{bench_push}), own[0].number(double{bench_stick}));
    const Expression force = gap * stiffness / distance;
    const auto sum = [&](const char* name, Expression value) {
        b.result(name, b.link_sum(touches.choose(value, value.number(0)).id()));
    };
    sum("x'", force * dx);
    sum("y'", force * dy);
    sum("z'", force * dz);
    sum("turn x", own[5] * theirs[6] - own[6] * theirs[5]);
    sum("turn y", own[6] * theirs[4] - own[4] * theirs[6]);
    sum("turn z", own[4] * theirs[5] - own[5] * theirs[4]);
    return std::move(b).finish();
}

void rates_of_kernel(Scene& s, const Kernel& kernel) {
    const std::vector<const float*> fields = fields_of(s);
    std::vector<float*> planes;
    for (Plane<float>& plane : s.rates) planes.push_back(plane.origin());
    const PlaneLayout layout = s.tissue->layout();
    const FlushDenormals environment;
    kernel.run(KernelArguments{fields, {}, {}, planes, layout, s.links.table<float>()},
               {{0, layout.height}});
}

/// The tissue's data as plain C++ reads it: vectors with one number per cell.
struct StraightCells {
    explicit StraightCells(const Scene& scene)
        : lists(scene.lists), to(results, std::vector<float>(cells)) {
        for (std::size_t k = 0; k < species; ++k) {
            values.emplace_back();
            for (std::size_t cell = 0; cell < cells; ++cell) {
                values.back().push_back(static_cast<float>(scene.tissue->value(k, cell)));
            }
        }
    }
    void run() {
        straight_rates({lists.ends, lists.neighbours, values[0].data(), values[1].data(),
                        values[2].data(), values[3].data(), values[4].data(), values[5].data(),
                        values[6].data(), to[0].data(), to[1].data(), to[2].data(), to[3].data(),
                        to[4].data(), to[5].data()});
    }
    const NeighbourLists& lists;
    std::vector<std::vector<float>> values, to;
};

KernelPointer native_rates() {
    auto backend = make_jit({0, 2});
    if (!backend) std::abort();
    const auto kernel = (*backend)->compile(rates_kernel(), Stencil::linked);
    if (!kernel) std::abort();
    return *kernel;
}

/// Checks that both sides compute the same rates.
void check_agreement() {
    Scene& s = scene();
    StraightCells straight(s);
    straight.run();
    rates_of_kernel(s, *native_rates());
    for (std::size_t k = 0; k < results; ++k) {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const float ours = s.rates[k].origin()[s.tissue->element(cell)];
            if (std::abs(ours - straight.to[k][cell]) <= 1e-5F * (1 + std::abs(ours))) continue;
            std::fprintf(stderr, "cell %zu: %g and %g\n", cell, double{ours},
                         double{straight.to[k][cell]});
            std::exit(1);
        }
    }
}

void rates_native(benchmark::State& state) {
    const KernelPointer kernel = native_rates();
    for (auto unused : state) rates_of_kernel(scene(), *kernel);
    count_cells(state);
}

void rates_straight(benchmark::State& state) {
    StraightCells straight(scene());
    for (auto unused : state) straight.run();
    count_cells(state);
}

BENCHMARK(neighbours)->Unit(benchmark::kMillisecond);
BENCHMARK(table_of_links)->Unit(benchmark::kMillisecond);
BENCHMARK(order)->Unit(benchmark::kMillisecond);
BENCHMARK(sense)->Unit(benchmark::kMillisecond);
BENCHMARK(rates_native)->Unit(benchmark::kMillisecond);
BENCHMARK(rates_straight)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    cascade::bench::check_agreement();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
