// Moments of an animated model, computed as by a renderer: the mesh plus the weighted differences
// of its morph targets.
#include "export/glb.h"
#include "picture/srgb.h"
#include "unit/export/decoded_glb.h"
#include "unit/export/example_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cascade {
namespace {

using test::Decoded;

/// A square that rises and turns from one colour to another.
GlbMoment moment_at(const SurfaceMesh& mesh, double part, bool rises) {
    GlbMoment moment;
    for (const Vector3d& p : mesh.points) {
        moment.colours.push_back({static_cast<float>(part), static_cast<float>(p.x),
                                  static_cast<float>(1 - part * p.y)});
        if (rises) moment.points.push_back({p.x, p.y, part * p.x * p.x});
    }
    return moment;
}

/// Compares the animation at a time with expected colours and positions.
void expect_moment(const Decoded& file, double time, const std::vector<double>& light,
                   const std::vector<double>& places) {
    const auto& mesh = file.json["meshes"][0];
    const auto& primitive = mesh["primitives"][0];
    const auto& sampler = file.json["animations"][0]["samplers"][0];
    const std::vector<double> times = file.numbers(sampler["input"]);
    const std::vector<double> weights = file.numbers(sampler["output"]);
    const std::size_t targets = primitive["targets"].size();
    ASSERT_EQ(weights.size(), targets * times.size());
    ASSERT_EQ(mesh["weights"].size(), targets);
    std::vector<double> colour = file.numbers(primitive["attributes"]["COLOR_0"]);
    for (double& level : colour) level /= 65535;
    std::vector<double> place = file.numbers(primitive["attributes"]["POSITION"]);
    std::size_t before = 0;
    while (before + 2 < times.size() && times[before + 1] < time) ++before;
    const double along = (time - times[before]) / (times[before + 1] - times[before]);
    for (std::size_t k = 0; k < targets; ++k) {
        const double weight = (1 - along) * weights[before * targets + k] +
                              along * weights[(before + 1) * targets + k];
        const std::vector<double> colours = file.numbers(primitive["targets"][k]["COLOR_0"]);
        const std::vector<double> moves = file.numbers(primitive["targets"][k]["POSITION"]);
        for (std::size_t c = 0; c < colour.size(); ++c) colour[c] += weight * colours[c];
        for (std::size_t c = 0; c < place.size(); ++c) place[c] += weight * moves[c];
    }
    ASSERT_EQ(place.size(), places.size());
    const auto& node = file.json["nodes"][0];
    for (std::size_t c = 0; c < place.size() && node.contains("translation"); ++c) {
        place[c] += node["translation"][c % 3].get<double>();
    }
    for (std::size_t c = 0; c < place.size(); ++c) EXPECT_NEAR(place[c], places[c], 1e-6);
    for (std::size_t v = 0; v < place.size() / 3; ++v) {
        EXPECT_EQ(colour[4 * v + 3], 1);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(colour[4 * v + c], light[3 * v + c], 4e-5);
        }
    }
}

/// A second track scales the node, and ends with the size of the mesh.
TEST(GrowingGlb, ScalesModelsThatGrow) {
    SurfaceMesh mesh = test::flat_square(3);
    std::vector<GlbMoment> moments;
    for (const double scale : {0.25, 0.5}) {
        moments.push_back(moment_at(mesh, scale, false));
        moments.back().scale = scale;
    }
    const GlbMoment last = moment_at(mesh, 1, false);
    GlbLook look;
    look.colours = last.colours;
    const Decoded file(*encode_growing_glb(mesh, look, {moments, 0.5}));
    const auto& animation = file.json["animations"][0];
    ASSERT_EQ(animation["channels"].size(), 2u);
    const auto& channel = animation["channels"][1];
    EXPECT_EQ(channel["target"]["path"], "scale");
    EXPECT_EQ(channel["target"]["node"], 0);
    const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    EXPECT_EQ(file.numbers(sampler["input"]), (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(file.numbers(sampler["output"]),
              (std::vector<double>{0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 1, 1, 1}));
}

TEST(GrowingGlb, ShowsEachMomentAtItsTime) {
    SurfaceMesh mesh = test::flat_square(3);
    mesh.texture.clear();  // Without seams a vertex is a point.
    for (const bool rises : {true, false}) {
        std::vector<GlbMoment> moments;
        for (const double part : {0.0, 0.25, 0.75}) moments.push_back(moment_at(mesh, part, rises));
        const GlbMoment last = moment_at(mesh, 1, rises);
        SurfaceMesh end = mesh;
        if (rises) end.points = last.points;
        GlbLook look;
        look.colours = last.colours;
        const Decoded file(*encode_growing_glb(end, look, {moments, 0.5}));
        moments.push_back(last);
        const auto light_of_moment = [&](std::size_t k) {
            std::vector<double> light;
            for (const Colour& colour : moments[k].colours) {
                for (const float channel : colour) {
                    light.push_back(static_cast<double>(light_of(channel)));
                }
            }
            return light;
        };
        const auto places_of_moment = [&](std::size_t k) {
            std::vector<double> places;
            for (const Vector3d& p : rises ? moments[k].points : mesh.points) {
                places.insert(places.end(), {p.x, p.y, p.z});
            }
            return places;
        };
        for (std::size_t k = 0; k < moments.size(); ++k) {
            expect_moment(file, 0.5 * static_cast<double>(k), light_of_moment(k),
                          places_of_moment(k));
        }
        // Half way between two moments the mean of both is shown.
        auto light = light_of_moment(1), places = places_of_moment(1);
        const auto mix = [](std::vector<double>& a, const std::vector<double>& b) {
            for (std::size_t k = 0; k < a.size(); ++k) a[k] = (a[k] + b[k]) / 2;
        };
        mix(light, light_of_moment(2));
        mix(places, places_of_moment(2));
        expect_moment(file, 0.75, light, places);
    }
}

TEST(GrowingGlb, NormalsFollowTheShape) {
    SurfaceMesh mesh = test::flat_square(3);
    mesh.texture.clear();
    // From a slope of 45 degrees to the plane.
    std::vector<GlbMoment> moments(1);
    for (const Vector3d& p : mesh.points) moments[0].points.push_back({p.x, p.y, p.x});
    moments[0].colours.resize(mesh.points.size());
    GlbLook look;
    const std::vector<Colour> colours(mesh.points.size());
    look.colours = colours;
    const Decoded file(*encode_growing_glb(mesh, look, {moments, 1}));
    const auto& primitive = file.json["meshes"][0]["primitives"][0];
    const auto turns = file.numbers(primitive["targets"][0]["NORMAL"]);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        EXPECT_NEAR(turns[3 * v], -std::sqrt(0.5), 1e-6);
        EXPECT_NEAR(turns[3 * v + 1], 0, 1e-6);
        EXPECT_NEAR(turns[3 * v + 2], std::sqrt(0.5) - 1, 1e-6);
    }
}

TEST(GrowingGlb, WithoutAGrowthIsTheModel) {
    const SurfaceMesh mesh = test::sphere_with_texture(6);
    EXPECT_EQ(*encode_growing_glb(mesh, {}, {}), *encode_glb(mesh, {}));
}

}  // namespace
}  // namespace cascade
