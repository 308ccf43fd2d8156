// Copies of meshes, compared with the same triangles as one mesh.
#include "render/draw.h"
#include "unit/mesh/example_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// A field of bent thorns of two forms and different sizes.
Instances thorns(int side) {
    Instances scene;
    for (const double form : {0.3, 1.0}) {
        scene.meshes.push_back(test::thorn(form, 0.6, {1, 0.03}));
    }
    for (int k = 0; k < side * side; ++k) {
        const double a = 0.7 * k;
        Placement placement;
        placement.mesh = static_cast<std::uint32_t>(k % 2);
        placement.place = {static_cast<double>(k % side) / side, 0.05 * std::sin(a),
                           std::floor(static_cast<double>(k) / side) / side};
        const Vector3d y = unit(Vector3d{0.3 * std::sin(2 * a), 1, 0.2});
        const Vector3d x = unit(cross(y, Vector3d{std::sin(a), 0, std::cos(a)}));
        placement.turn = quaternion_of(x, y, cross(x, y));
        placement.scale = Vector3d{1, 1.5 + std::sin(a), 0.8} * (0.5 / side);
        placement.colour = k % 3 == 0 ? Colour{0.8F, 0.3F, 0.2F} : Colour{0.3F, 0.4F, 0.8F};
        scene.placements.push_back(placement);
    }
    return scene;
}

/// All copies as one mesh, with the number of the first triangle of each.
TriangleMesh merged(const Instances& scene, std::vector<std::uint32_t>& firsts) {
    TriangleMesh result;
    for (const Placement& placement : scene.placements) {
        firsts.push_back(static_cast<std::uint32_t>(result.triangles.size()));
        TriangleMesh copy = scene.meshes[placement.mesh];
        const PlacementMap map(placement);
        for (Vector3& p : copy.positions) p = map.point(p);
        for (Vector3& n : copy.normals) n = map.normal(n);
        append(copy, result);
    }
    return result;
}

DrawOptions options_of(std::int64_t side) {
    DrawOptions options;
    options.width = options.height = side;
    options.view = {30, 40, {0, 1, 0}};
    return options;
}

Image picture_of(const Scene& scene, const SurfaceLook& look, const DrawOptions& options,
                 int threads = 1) {
    Team team(threads);
    return draw(RayCaster(scene), look, options, team);
}

Look white(const Sight&) { return {{1, 1, 1}, {}}; }

TEST(Scene, RaysHitCopiesWhereTheirTrianglesAre) {
    const Instances copies = thorns(6);
    std::vector<std::uint32_t> firsts;
    const TriangleMesh mesh = merged(copies, firsts);
    const RayCaster of_copies(Scene(nullptr, &copies));
    const RayCaster of_mesh{Scene(mesh)};
    int hits = 0;
    for (int k = 0; k < 4000; ++k) {
        const Ray ray{{-0.1F + static_cast<float>(k % 63) / 52, 2,
                       -0.1F + static_cast<float>(k) / 3300},
                      unit(Vector3{0.1F, -1, 0.2F})};
        const auto one = of_copies.nearest(ray), other = of_mesh.nearest(ray);
        ASSERT_EQ(one.has_value(), other.has_value());
        EXPECT_EQ(of_copies.is_blocked(ray, 100), one.has_value());
        if (!one) continue;
        ++hits;
        EXPECT_EQ(other->copy, Hit::body);
        ASSERT_LT(one->copy, copies.placements.size());
        EXPECT_NEAR(one->distance, other->distance, 1e-5);
        EXPECT_EQ(firsts[one->copy] + one->triangle, other->triangle);
        const auto facet = Scene(nullptr, &copies).facet(*one);
        const auto wanted = Scene(mesh).facet(*other);
        EXPECT_NEAR(facet.shade, wanted.shade, 1e-3);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(facet.positions[c], wanted.positions[c]);
            EXPECT_EQ(facet.normals[c], wanted.normals[c]);
        }
    }
    EXPECT_GT(hits, 800);
}

TEST(Scene, HitsTellCopiesFromTheBody) {
    TriangleMesh body;
    body.positions = {{-3, 0, -3}, {3, 0, -3}, {0, 0, 3}};
    body.triangles = {{0, 2, 1}};
    smooth_normals(body);
    Instances copies;
    copies.meshes = {body};
    for (const float x : {-0.5F, 0.5F}) {
        Placement placement;
        placement.place = {static_cast<double>(x), 1, 0};
        placement.scale = {0.1, 1, 0.1};
        copies.placements.push_back(placement);
    }
    const RayCaster caster(Scene(&body, &copies));
    const auto under = [&](float x) { return caster.nearest({{x, 5, 0}, {0, -1, 0}}); };
    EXPECT_EQ(under(0)->copy, Hit::body);
    EXPECT_FLOAT_EQ(under(0)->distance, 5);
    EXPECT_EQ(under(-0.5F)->copy, 0u);
    EXPECT_EQ(under(0.5F)->copy, 1u);
    EXPECT_FLOAT_EQ(under(0.5F)->distance, 4);
}

TEST(Scene, LooksLikeOneMeshOfTheSameTriangles) {
    const Instances copies = thorns(40);
    std::vector<std::uint32_t> firsts;
    const TriangleMesh mesh = merged(copies, firsts);
    const DrawOptions options = options_of(200);
    const Image image = picture_of(Scene(nullptr, &copies), {}, options);
    const Image wanted = [&] {
        Team team(1);
        return draw(
            mesh,
            [&](const Hit& hit) {
                const auto next = std::upper_bound(firsts.begin(), firsts.end(), hit.triangle);
                return copies.placements[static_cast<std::size_t>(next - firsts.begin() - 1)]
                    .colour;
            },
            options, team);
    }();
    // Among many copies fewer rays are sent, which adds grain but no light.
    double squares = 0;
    Colour sum{}, wanted_sum{};
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double error = static_cast<double>(image.pixels[k][c] - wanted.pixels[k][c]);
            squares += error * error / 3;
            sum[c] += image.pixels[k][c];
            wanted_sum[c] += wanted.pixels[k][c];
        }
    }
    EXPECT_LT(std::sqrt(squares / 40000), 0.06);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / wanted_sum[c], 1, 0.01);
}

TEST(Scene, ThreadsDoNotMatter) {
    const Instances copies = thorns(12);
    TriangleMesh ground;
    ground.positions = {{0, -0.1F, 0}, {1, -0.1F, 0}, {0, -0.1F, 1}};
    ground.triangles = {{0, 2, 1}};
    smooth_normals(ground);
    const Scene scene(&ground, &copies);
    const Image one = picture_of(scene, white, options_of(120), 1);
    EXPECT_TRUE(one.pixels == picture_of(scene, white, options_of(120), 3).pixels);
}

TEST(Scene, TheCameraFramesAllCopies) {
    Instances copies = thorns(2);
    copies.placements[3].place = {9, 4, 2};
    DrawOptions options = options_of(100);
    options.ground = false;
    for (const bool is_turning : {false, true}) {
        options.view.is_turning = is_turning;
        const Image image = picture_of(Scene(nullptr, &copies), {}, options);
        int seen = 0;
        for (std::int64_t y = 0; y < 100; ++y) {
            for (std::int64_t x = 0; x < 100; ++x) {
                if (image.at(x, y) == Colour{1, 1, 1}) continue;
                ++seen;
                EXPECT_TRUE(x >= 4 && x < 96 && y >= 4 && y < 96) << x << ' ' << y;
            }
        }
        EXPECT_GT(seen, 0);
    }
}

TEST(Scene, ShadesDarkenCopies) {
    Instances copies;
    copies.meshes.push_back(test::ball({1, 0.01}));
    copies.placements.push_back({});
    DrawOptions options = options_of(60);
    const float plain = picture_of(Scene(nullptr, &copies), {}, options).at(30, 30)[1];
    copies.meshes[0].shades.assign(copies.meshes[0].positions.size(), 0.25F);
    const float shaded = picture_of(Scene(nullptr, &copies), {}, options).at(30, 30)[1];
    EXPECT_LT(shaded, 0.7F * plain);
}

}  // namespace
}  // namespace cascade
