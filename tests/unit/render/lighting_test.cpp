// Soft lights, compared with numerical integrals over the sphere.
#include "render/lighting.h"

#include "render/camera.h"
#include "render/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace cascade {
namespace {

using std::numbers::pi;

TriangleMesh one_triangle() {
    TriangleMesh mesh;
    mesh.positions = {{-1, -1, -1}, {1, -1, 1}, {0, 1, 0}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

Lights lights(Lighting lighting) {
    static const TriangleMesh mesh = one_triangle();
    return {lighting, Camera(Scene(mesh), {}, 80, 60), {0, 0, 1}};
}

/// A perfect mirror, with which mirrored() is the radiance of the environment.
constexpr Gloss mirror{1, 1e6F, 1};

/// The integral over the sphere of e · the green radiance of the soft lights, over pi.
double integral(const Lights& set, const std::function<double(const Vector3&)>& e,
                const Gloss& gloss = mirror) {
    constexpr int rows = 200, columns = 400;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double height = (2 * i + 1.0) / rows - 1, radius = std::sqrt(1 - height * height);
        for (int j = 0; j < columns; ++j) {
            const double angle = 2 * pi * (j + 0.5) / columns;
            const Vector3 at{static_cast<float>(radius * std::cos(angle)),
                             static_cast<float>(radius * std::sin(angle)),
                             static_cast<float>(height)};
            sum += e(at) * static_cast<double>(set.mirrored(at, gloss)[1]);
        }
    }
    return sum * 4 / (rows * columns);
}

TEST(Lighting, surfaces_have_the_light_of_the_half_of_the_environment_that_they_face) {
    for (const Lighting lighting : {Lighting::studio, Lighting::outdoors}) {
        const Lights set = lights(lighting);
        double most = 0;
        for (const Vector3 normal : {Vector3{1, 0, 0},
                                     {-1, 0, 0},
                                     {0, 1, 0},
                                     {0, -1, 0},
                                     {0, 0, 1},
                                     {0, 0, -1},
                                     unit(Vector3{1, 2, 3})}) {
            const double expected = integral(set, [&](const Vector3& at) {
                return std::max(0.0, static_cast<double>(dot(at, normal)));
            });
            most = std::max(most, std::abs(expected));
            EXPECT_NEAR(set.soft(normal)[1], expected, 0.05) << name_of(lighting);
        }
        EXPECT_GT(most, 0.2) << name_of(lighting);
    }
}

TEST(Lighting, a_rough_mirror_shows_as_much_light_as_a_smooth_one) {
    const auto one = [](const Vector3&) { return 1.0; };
    for (const Lighting lighting : {Lighting::studio, Lighting::outdoors}) {
        const Lights set = lights(lighting);
        EXPECT_NEAR(integral(set, one, {1, 20, 1}), integral(set, one), 0.01) << name_of(lighting);
    }
}

TEST(Lighting, the_sun_alone_shines_from_a_sky_that_is_even) {
    const Lights set = lights(Lighting::sun);
    EXPECT_EQ(set.soft({0, 0, 1}), (Colour{0, 0, 0}));
    EXPECT_EQ(set.mirrored({0, 0, 1}, mirror), (Colour{0, 0, 0}));
    EXPECT_EQ(set.even[0], set.even[2]);
}

TEST(Lighting, what_is_smooth_mirrors_at_grazing_angles) {
    EXPECT_NEAR(reflectance(1, mirror), 0.04, 1e-6);
    EXPECT_GT(reflectance(0, mirror), 0.9F);
    EXPECT_LT(reflectance(0, gloss_of(1, 0)), 0.3F);
    EXPECT_GT(reflectance(0.2F, gloss_of(0.2F, 0)), reflectance(0.2F, gloss_of(0.8F, 0)));
}

TEST(Lighting, names_are_found_again) {
    for (const std::string_view name : lighting_names) {
        EXPECT_EQ(name_of(lighting_named(name).value()), name);
    }
    EXPECT_FALSE(lighting_named("moon"));
}

}  // namespace
}  // namespace cascade
