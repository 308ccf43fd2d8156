// Models that do not stand upright or face another way: scripts and pictures treat a model in all
// positions alike, and written files have the coordinates of the file that was read.
#include "mesh/model_file.h"
#include "mesh/shapes.h"
#include "picture/grey_picture.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/script/embedded_script.h"
#include "run_fixture.h"
#include "surface/place_values.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

class Upright : public RunTest {
protected:
    void SetUp() override {
        RunTest::SetUp();
        for (const Axis up : {Axis::x, Axis::y, Axis::z}) {
            write_lopsided(std::string(name_of(up)), usual_stance(up));
        }
    }

    /// Writes a textured, bent ring without any symmetry, in this position.
    void write_lopsided(const std::string& name, const Stance& stance) const {
        const auto mesh = torus_mesh(1, 0.4, 0.25);
        ASSERT_TRUE(mesh);
        std::string text;
        for (const Vector3d& p : mesh->points) {
            const Vector3d bent{1.3 * p.x + 0.2 * p.y, p.y + 0.4 * p.x * p.x + 0.1 * p.z,
                                0.8 * p.z + 0.3 * p.x};
            const Vector3d v = turned_from_upright(bent, stance);
            text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
        }
        for (const auto& corners : mesh->texture) {
            for (const TexturePlace& place : corners)
                text += fmt::format("vt {} {}\n", place[0], place[1]);
        }
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            const auto& [a, b, c] = mesh->triangles[t];
            text += fmt::format("f {}/{} {}/{} {}/{}\n", a + 1, 3 * t + 1, b + 1, 3 * t + 2, c + 1,
                                3 * t + 3);
        }
        ASSERT_TRUE(write_file(path(name + ".obj"), text));
    }

    /// The script's only stage at its end.
    std::unique_ptr<Simulation> grown(Axis file, const std::string& domain,
                                      const std::string& stage, const Overrides& overrides = {}) {
        return grown(std::string(name_of(file)), domain, stage, overrides);
    }
    std::unique_ptr<Simulation> grown(const std::string& file, const std::string& domain,
                                      const std::string& stage, const Overrides& overrides = {}) {
        script_ = load(fmt::format("domain {{ mesh: \"{}.obj\"; cells: 300; {} }}\n{}", file,
                                   domain, stage),
                       overrides);
        EXPECT_TRUE(script_.program) << script_.messages(false);
        if (!script_.program) return nullptr;
        auto made = Simulation::create(script_, {"interp", 0, 1});
        EXPECT_TRUE(made) << script_.messages(false);
        if (!made || !(*made)->start_stage(0)) return nullptr;
        RunControl control;
        const auto end =
            (*made)->advance_stage(0, script_.program->stages[0].iterations, control, {});
        EXPECT_TRUE(end) << (end ? "" : end.error().message);
        return *std::move(made);
    }

    static std::vector<double> first_species(const std::unique_ptr<Simulation>& simulation) {
        if (!simulation) return {};
        return cell_values(simulation->state(0).species()[0], *simulation->domain().model->cells);
    }

    static std::string up_is(Axis up) { return fmt::format("up: {}", name_of(up)); }

    Script script_;
};

/// A script that uses everything in the language that depends on directions and places.
constexpr const char* all_of_space = R"(
system s {
  place: x + 2 * y + 4 * z + 8 * sx + 16 * sy + 32 * sz
  normal: nx + 3 * ny + 9 * nz
  bend: curvature + curvature_low
  far: distance(0.1, 0.2, 0.9, 0.8, 0, 0)
  key: keys(0, 0, 0, 1, 0.9, 0.3, 0.1, 2)
  near: disc(0.2, 0.2, 0.4, 0.2) + gauss(0.9, 0.3, 0.3, 0.1) + noise(4)
  u: place + random(1, 0.1)
  u' = 0.1 * lap(u) + dx(u) + 2 * dy(u) - 3 * dz(u) + normal + bend + far + key + near
}
stage one: s { iterations: 3; speed: 0.01 }
)";

TEST_F(Upright, ScriptsSeeTheSameModelBitForBit) {
    for (const char* directions :
         {"", "directions: axis(1, 2, 4)", "directions: gradient(x + 2 * y - z^2)",
          "directions: keys(0, 0, 0, 1, 0, 0, 1, 0.3, 0.5, 0, 0, 1)"}) {
        const auto expected =
            first_species(grown(Axis::y, fmt::format("{}; up: y", directions), all_of_space));
        ASSERT_EQ(expected.size(), 300u);
        for (const Axis up : {Axis::x, Axis::z}) {
            const auto got = first_species(
                grown(up, fmt::format("{}; {}", directions, up_is(up)), all_of_space));
            EXPECT_EQ(got, expected) << directions << " " << up_is(up);
        }
    }
    EXPECT_NE(first_species(grown(Axis::z, "", all_of_space)),
              first_species(grown(Axis::y, "", all_of_space)));
}

TEST_F(Upright, ScriptsSeeTheSameModelWhereverItLooks) {
    const auto expected = first_species(grown(Axis::y, "", all_of_space));
    for (const char* up : {"x", "y", "z"}) {
        for (const std::string_view facing : heading_names) {
            const Heading heading = *heading_of_name(facing);
            if (name_of(heading.axis) == up) continue;
            write_lopsided("turned", {*axis_of_name(up), heading});
            const std::string stands = fmt::format("up: {}; facing: {}", up, facing);
            EXPECT_EQ(first_species(grown("turned", stands, all_of_space)), expected) << stands;
        }
    }
    EXPECT_NE(first_species(grown(Axis::y, "facing: -z", all_of_space)), expected);
    EXPECT_NE(first_species(grown(Axis::y, "facing: x", all_of_space)), expected);
}

TEST_F(Upright, TheOptionIsTheStatement) {
    Overrides overrides;
    overrides.up = Axis::z;
    const auto expected = first_species(grown(Axis::y, "", all_of_space));
    EXPECT_EQ(first_species(grown(Axis::z, "", all_of_space, overrides)), expected);
    EXPECT_EQ(first_species(grown(Axis::z, "up: x", all_of_space, overrides)), expected);
    overrides.model = path("z.obj").string();
    overrides.model_is_asked_for = true;
    EXPECT_EQ(first_species(grown(Axis::x, "up: x", all_of_space, overrides)), expected);
    // What a script states about its own model does not hold for a model that replaces it.
    overrides.model = path("y.obj").string();
    overrides.up.reset();
    EXPECT_EQ(first_species(grown(Axis::x, "up: x", all_of_space, overrides)), expected);
    EXPECT_EQ(first_species(grown(Axis::x, "facing: y", all_of_space, overrides)), expected);
    overrides.facing = Heading{Axis::z, true};
    EXPECT_EQ(first_species(grown(Axis::x, "facing: x", all_of_space, overrides)),
              first_species(grown(Axis::y, "facing: -z", all_of_space)));
}

TEST_F(Upright, ItIsRefusedOnPlanesAndTravelsInPictures) {
    Overrides overrides;
    overrides.up = Axis::z;
    EXPECT_THAT(
        load("domain { grid: 9, 9 }\nstage one: turing_spots { }\n", overrides).messages(false),
        ::testing::HasSubstr("<--up>:1:1: error: this setting needs a domain with a model"));
    const auto back = overrides_from_json(overrides_to_json(overrides));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->up, Axis::z);
    EXPECT_FALSE(back->facing);
    overrides.facing = Heading{Axis::x, true};
    EXPECT_EQ(overrides_from_json(overrides_to_json(overrides))->facing, overrides.facing);
    for (const char* wrong : {R"({"up": "w"})", R"({"up": ""})", R"({"up": 2})",
                              R"({"facing": "+x"})", R"({"facing": 1})"}) {
        EXPECT_FALSE(overrides_from_json(wrong)) << wrong;
    }
    Overrides changes;
    EXPECT_EQ(merge(overrides, changes).up, Axis::z);
    EXPECT_EQ(merge(overrides, changes).facing, overrides.facing);
    changes.model = "other.ply";
    EXPECT_FALSE(merge(overrides, changes).up);
    EXPECT_FALSE(merge(overrides, changes).facing);
    changes.up = Axis::x;
    EXPECT_EQ(merge(overrides, changes).up, Axis::x);
    changes = {};
    changes.grid = GridSize{9, 9};
    EXPECT_FALSE(merge(overrides, changes).up);
}

constexpr const char* few_spots = "stage one: turing_spots { iterations: 60 }\n";

TEST_F(Upright, PicturesShowItUpright) {
    const auto picture = [&](Axis file, const std::string& domain) {
        const auto simulation = grown(file, domain, few_spots);
        if (!simulation) return Image();
        PictureRequest request;
        request.bump = 0.05F;
        auto painter = Painter::create(script_, request);
        EXPECT_TRUE(painter);
        return painter ? painter->image(painter->canvas(*simulation)) : Image();
    };
    const Image expected = picture(Axis::y, "");
    ASSERT_GT(expected.width, 0);
    EXPECT_EQ(picture(Axis::x, "up: x").pixels, expected.pixels);
    EXPECT_EQ(picture(Axis::z, "up: z").pixels, expected.pixels);
    EXPECT_NE(picture(Axis::z, "up: z; facing: y").pixels, expected.pixels);
}

TEST_F(Upright, FilesHaveTheCoordinatesOfTheModelsOwn) {
    const auto original = read_model(path("z.obj"));
    ASSERT_TRUE(original);
    // Cells at the points of the mesh do not depend on the axis, so only the axis can make files
    // differ.
    for (const auto& [up, stands] :
         {std::pair("y", "up: y"), std::pair("z", "up: z"), std::pair("x", "up: x; facing: -z")}) {
        Script script = load(fmt::format("domain {{ mesh: \"z.obj\"; cells: vertices; {} }}\n{}",
                                         stands, few_spots));
        RunRequest all = request();
        all.outputs.clear();
        for (const char* name : {"{}.ply", "{}.glb", "{}.vtp", "{}.cells.vtp"}) {
            all.outputs.push_back(path(fmt::format(fmt::runtime(name), up)));
        }
        run_well(script, all);
        const auto written = read_model(path(fmt::format("{}.ply", up)));
        ASSERT_TRUE(written);
        ASSERT_GE(written->points.size(), original->points.size());
        EXPECT_TRUE(
            std::equal(original->points.begin(), original->points.end(), written->points.begin()));
    }
    const auto turned = read_model(path("z.ply")), plain = read_model(path("y.ply"));
    EXPECT_EQ(turned->points, plain->points);
    std::size_t normals = 0;
    for (std::size_t k = 0; k < plain->attributes.size(); ++k) {
        const std::string& name = plain->attributes[k].name;
        if (name != "nx" && name != "ny" && name != "nz") continue;
        EXPECT_EQ(turned->attributes[k].values, plain->attributes[k].values) << name;
        ++normals;
    }
    EXPECT_EQ(normals, 3u);
    const auto turned_glb = read_model(path("z.glb")), plain_glb = read_model(path("y.glb"));
    ASSERT_TRUE(turned_glb && plain_glb);
    EXPECT_EQ(turned_glb->points, plain_glb->points);
}

TEST_F(Upright, ReTiledModelsHaveTheCellsWhereTheyAreInTheFile) {
    const auto simulation = grown(Axis::z, "up: z", few_spots);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    const SurfaceMesh mesh = model.mesh_of_file();
    RunRequest tiled = request();
    tiled.outputs = {path("tiled.ply")};
    tiled.model_files.retile = true;
    run_well(script_, tiled);
    const auto written = read_model(path("tiled.ply"));
    ASSERT_TRUE(written);
    for (std::size_t k = 0; k < model.count(); ++k) {
        const Vector3d place = position_of(mesh, model.spread().cells.places[k]);
        EXPECT_LT(length(written->points[k] - place), 1e-5) << k;
    }
}

TEST_F(Upright, BakedMapsAreThoseOfTheUprightModel) {
    const auto bake = [&](Axis file) {
        const auto simulation = grown(file, up_is(file), few_spots);
        PictureRequest request;
        request.bump = 0.05F;
        auto painter = Painter::create(script_, request);
        if (!simulation || !painter) return;
        const Canvas canvas = painter->canvas(*simulation);
        const ModelLook look = painter->look(canvas);
        ModelFileWriter writer(*simulation->domain().model->cells, {}, look, {}, {false, 64}, {});
        EXPECT_TRUE(writer.write(path(fmt::format("{}.glb", name_of(file)))));
    };
    bake(Axis::y);
    for (const Axis axis : {Axis::x, Axis::z}) {
        bake(axis);
        for (const char* map : {"color", "height", "normal"}) {
            const auto expected = read_grey_picture(path(fmt::format("y_{}.png", map)));
            const auto got = read_grey_picture(path(fmt::format("{}_{}.png", name_of(axis), map)));
            ASSERT_TRUE(expected && got);
            ASSERT_EQ(got->values.size(), expected->values.size());
            // Occlusion is rounded differently in other coordinates, which makes a difference of
            // 0.001.
            double difference = 0, least = 1, most = 0;
            for (std::size_t k = 0; k < got->values.size(); ++k) {
                const double texel{expected->values[k]};
                difference += std::abs(double{got->values[k]} - texel);
                least = std::min(least, texel);
                most = std::max(most, texel);
            }
            EXPECT_GT(most - least, 0.1) << map;
            EXPECT_LT(difference / static_cast<double>(got->values.size()), 0.004) << map;
        }
    }
}

}  // namespace
}  // namespace cascade
