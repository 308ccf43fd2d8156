// cascade_copies_bench: a picture and files of many copies of a small mesh on a sphere.
//
// usage: cascade_copies_bench [SHAPE [COPIES [SIDE [FILE.png]]]]   by default a thorn, 100,000 and
// 1024 pixels
//
// Prints the processor time of each phase, in seconds.
#include "export/instanced_model.h"
#include "mesh/shapes.h"
#include "picture/image.h"
#include "lang/check/picture_shape.h"
#include "lang/library/library.h"
#include "render/draw.h"
#include "run/pictures/shape_meshes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

namespace cascade::bench {
namespace {

/// Calls `work` and returns its result. Prints the time that it took on all threads together.
template <typename Work>
auto timed(const char* what, const Work& work) {
    const std::clock_t before = std::clock();
    auto result = work();
    fmt::print("{:<20}{:8.3f} s\n", what,
               static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    return result;
}

TriangleMesh sphere() {
    const SurfaceMesh mesh = *sphere_mesh(1, 0.05);
    TriangleMesh drawn;
    for (const Vector3d& p : mesh.points) {
        drawn.positions.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    drawn.triangles = mesh.triangles;
    smooth_normals(drawn);
    return drawn;
}

/// Copies at evenly spread positions (a Fibonacci lattice), combed downwards, so large that they
/// cover the sphere.
std::vector<Placement> placements(int count, std::string_view shape) {
    const bool is_flat = shape == "plate" || shape == "feather";
    const double radius = 2.1 / std::sqrt(count);
    const double height = radius * (is_flat ? 0.6 : 2.5);
    std::vector<Placement> result;
    for (int k = 0; k < count; ++k) {
        const double up = 1 - (2 * k + 1.0) / count, across = std::sqrt(1 - up * up);
        const double around = std::numbers::pi * (3 - std::sqrt(5.0)) * k;
        const Vector3d normal{across * std::cos(around), up, across * std::sin(around)};
        const Vector3d down = unit(normal * up - Vector3d{0, 1, 0});
        const auto light =
            static_cast<float>(0.5 + 0.5 * std::sin(6 * up + 8 * normal.x * normal.z));
        result.push_back({0,
                          normal,
                          quaternion_of(cross(normal, down), normal, down),
                          {radius, height, radius},
                          {0.3F + 0.5F * light, 0.55F - 0.15F * light, 0.25F}});
    }
    return result;
}

int run(int argc, char** argv) {
    const char* name = argc > 1 ? argv[1] : "thorn";
    const int count = argc > 2 ? std::atoi(argv[2]) : 100000;
    const std::int64_t side = argc > 3 ? std::atoi(argv[3]) : 1024;
    if (find_shape_text(name) == nullptr || count < 1 || side < 1) {
        fmt::print(stderr, "cascade_copies_bench: [SHAPE [COPIES [SIDE [FILE.png]]]]\n");
        return 2;
    }
    Instances copies;
    copies.meshes.push_back(timed("mesh", [&] {
        const ShapeForm form = library_shape(name);
        return *mesh_of(parts_of(form, form.usual), {1, 0.04});
    }));
    copies.placements = placements(count, name);
    fmt::print("{} copies of {} triangles\n", count, copies.meshes[0].triangles.size());
    const TriangleMesh body = sphere();
    const auto caster =
        timed("tree", [&] { return std::make_unique<RayCaster>(Scene(&body, &copies)); });
    DrawOptions options;
    options.width = options.height = side;
    options.view = {30, 20, {0, 1, 0}};
    Team team(hardware_threads());
    const auto look = [](const Sight&) { return Look{{0.12F, 0.08F, 0.05F}, {}}; };
    const Image image = timed("picture", [&] { return draw(*caster, look, options, team); });
    const auto glb = timed("GLB of instances", [&] {
        return encode_instanced_glb({nullptr, {}, copies});
    });
    if (glb) fmt::print("{:.2f} MB\n", static_cast<double>(glb->size()) / 1e6);
    if (argc > 4 && !write_png(argv[4], image, PngDepth::eight, {})) return 1;
    return 0;
}

}  // namespace
}  // namespace cascade::bench

int main(int argc, char** argv) { return cascade::bench::run(argc, argv); }
