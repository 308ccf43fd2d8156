// cascade_simplify_bench: a sphere with bands of two colours is simplified to a twentieth of its
// triangles, on one core. Compares Cascade, which preserves the shape, or the shape and the
// colours, with OpenMesh's own quadrics and its test for triangles that turn over.
//
// All flags of Google Benchmark work. The argument of cases is the number of triangles. The counter
// `off` is the mean depth of the triangles' middles below the surface of the unit sphere.
#include "mesh/half_edges.h"
#include "mesh/shapes.h"
#include "mesh/simplify.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cascade::bench {
namespace {

constexpr std::size_t part_left = 20;

SurfaceMesh ball(const benchmark::State& state) {
    const double area = 4 * std::numbers::pi / static_cast<double>(state.range(0));
    return *sphere_mesh(1, std::sqrt(4 * area / std::sqrt(3.0)));
}

void report(benchmark::State& state, const SurfaceMesh& before, const SurfaceMesh& after) {
    double sum = 0;
    for (std::size_t t = 0; t < after.triangles.size(); ++t) {
        sum += 1 - length(after.corner(t, 0) + after.corner(t, 1) + after.corner(t, 2)) / 3;
    }
    state.counters["off"] = sum / static_cast<double>(after.triangles.size());
    state.counters["left"] = static_cast<double>(after.triangles.size());
    state.SetItemsProcessed(state.iterations() *
                            static_cast<std::int64_t>(before.triangles.size()));
}

void simplify_ours(benchmark::State& state, bool has_colours) {
    const SurfaceMesh mesh = ball(state);
    std::vector<std::array<float, 3>> colours;
    for (const Vector3d& p : mesh.points) {
        const float grey = std::sin(12 * p.x) > 0 ? 1.0F : 0.0F;
        if (has_colours) colours.push_back({grey, grey, grey});
    }
    const std::atomic<bool> never = false;
    Simplified left;
    for (auto turn : state) {
        left = *simplify(mesh, mesh.triangles.size() / part_left, {colours, 0.02}, never);
    }
    report(state, mesh, left.mesh);
}
void ours(benchmark::State& state) { simplify_ours(state, false); }
void ours_with_colours(benchmark::State& state) { simplify_ours(state, true); }

void openmesh(benchmark::State& state) {
    const SurfaceMesh mesh = ball(state);
    SurfaceMesh left;
    for (auto turn : state) {
        HalfEdges edited = *half_edges(mesh);
        edited.request_face_normals();
        edited.update_face_normals();
        OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(edited);
        OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle quadric;
        OpenMesh::Decimater::ModNormalFlippingT<HalfEdges>::Handle flipping;
        decimater.add(quadric);
        decimater.add(flipping);
        decimater.initialize();
        decimater.decimate_to_faces(0, mesh.triangles.size() / part_left);
        left = surface_mesh(edited);
    }
    report(state, mesh, left);
}

BENCHMARK(ours)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);
BENCHMARK(ours_with_colours)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);
BENCHMARK(openmesh)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cascade::bench

BENCHMARK_MAIN();
