// Values that places on a model give its cells, and cells stretched along directions.
#include "picture/image.h"
#include "run/domain/model_cells.h"
#include "run/simulation/simulation.h"
#include "run_fixture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

namespace cascade {
namespace {

constexpr double pi = std::numbers::pi;

class SurfaceValuesTest : public RunTest {
protected:
    /// The simulation of a script of one stage that has begun; null with a failed test.
    std::unique_ptr<Simulation> start(const std::string& domain,
                                      const std::string& statements = "") {
        script_ = load("domain { " + domain + " }\nsystem_name: turing_spots\n" + statements);
        EXPECT_EQ(script_.messages(false), "");
        if (!script_.program) return nullptr;
        SimulationOptions options;
        options.backend = BackendKind::interpreter;
        auto made = Simulation::create(script_, options);
        EXPECT_TRUE(made) << script_.messages(false);
        if (!made || !(*made)->start_stage(0)) return nullptr;
        return *std::move(made);
    }

    /// An expression as a starting value of `a`, in each cell.
    std::vector<double> values(const std::string& domain, const std::string& expression) {
        const auto simulation = start(domain, "a: " + expression + "\n");
        if (!simulation) return {};
        model_ = simulation->model();
        return cell_values(simulation->state(0).species[0], *model_);
    }

    /// The place of a cell, 0 … 1.
    Vector3d place(std::size_t cell) const {
        const ModelBox box(model_->mesh);
        return box.in_script(position_of(model_->mesh, model_->cells.places[cell]));
    }

    /// The messages of a script that cannot begin.
    std::string fault(const std::string& domain, const std::string& statements) {
        script_ = load("domain { " + domain + " }\nsystem_name: turing_spots\n" + statements);
        EXPECT_TRUE(script_.program) << script_.messages(false);
        if (!script_.program) return "";
        EXPECT_FALSE(Simulation::create(script_, {}));
        return script_.messages(false);
    }

    Script script_;
    std::shared_ptr<const ModelCells> model_;
};

constexpr const char* ball = "surface: sphere; cells: 600; unit: 1";

TEST_F(SurfaceValuesTest, DistancesOnABallAreArcs) {
    const std::vector<double> found = values(ball, "distance(0.5, 1, 0.5)");
    ASSERT_EQ(found.size(), 600u);
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        // The radius is half of the longest side.
        const double arc = std::acos(std::clamp(2 * place(cell).y - 1, -1.0, 1.0)) / 2;
        EXPECT_NEAR(found[cell], arc, 0.02) << cell;
    }
}

TEST_F(SurfaceValuesTest, TheNearestOfSeveralPlacesCounts) {
    const std::vector<double> found = values(ball, "distance(0.5, 1, 0.5, 0.5, 0, 0.5)");
    ASSERT_FALSE(found.empty());
    EXPECT_LT(*std::max_element(found.begin(), found.end()), pi / 4 + 0.03);
}

TEST_F(SurfaceValuesTest, WhereNoWayLeadsADistanceIsFiniteAndLarge) {
    // Two triangles that are not connected.
    std::ofstream(path("two.off")) << "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 0\n4 0 0\n3 1 0\n"
                                      "3 0 1 2\n3 3 4 5\n";
    const std::vector<double> found = values("mesh: \"two.off\"; cells: 40", "distance(0, 0, 0)");
    std::size_t beyond = 0;
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        if (place(cell).x > 0.5) {
            ++beyond;
            EXPECT_EQ(found[cell], 1000);
        } else {
            EXPECT_LT(found[cell], 0.4);
        }
    }
    EXPECT_GT(beyond, 5u);
}

TEST_F(SurfaceValuesTest, KeysWithoutSmoothingAreTheNearestOnes) {
    const std::vector<double> found = values(ball, "keys(0.5, 1, 0.5, 7, 0.5, 0, 0.5, 3, 0)");
    ASSERT_FALSE(found.empty());
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        if (std::abs(place(cell).y - 0.5) < 0.03) continue;
        EXPECT_EQ(found[cell], place(cell).y > 0.5 ? 7 : 3);
    }
}

TEST_F(SurfaceValuesTest, KeysGoOverIntoEachOther) {
    const std::vector<double> found = values(ball, "keys(0.5, 1, 0.5, 7, 0.5, 0, 0.5, 3)");
    ASSERT_FALSE(found.empty());
    std::size_t between = 0;
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        EXPECT_GE(found[cell], 3);
        EXPECT_LE(found[cell], 7);
        if (std::abs(place(cell).y - 0.5) < 0.03) {
            EXPECT_NEAR(found[cell], 5, 1.5);
            ++between;
        }
        if (place(cell).y > 0.95) {
            EXPECT_GT(found[cell], 6.5);
        }
    }
    EXPECT_GT(between, 5u);
}

TEST_F(SurfaceValuesTest, CurvaturesOfABallOfRadiusOne) {
    for (const char* name :
         {"curvature_mean", "curvature_gauss", "curvature_high", "curvature_low"}) {
        for (const double value : values(ball, name)) EXPECT_NEAR(value, 1, 0.05) << name;
    }
}

TEST_F(SurfaceValuesTest, OnATorusTheLowCurvatureIsNegativeInside) {
    const auto low = values("surface: torus(1, 0.4); cells: 600; unit: 1", "curvature_low");
    ASSERT_FALSE(low.empty());
    EXPECT_NEAR(*std::min_element(low.begin(), low.end()), -1 / 0.6, 0.1);
    EXPECT_NEAR(*std::max_element(low.begin(), low.end()), 1 / 1.4, 0.1);
}

TEST_F(SurfaceValuesTest, ValuesMayBeReadByRatesAndLate) {
    const auto simulation = start(ball, "show: distance(0.5, 1, 0.5)\n");
    ASSERT_TRUE(simulation);
    const auto shown = simulation->evaluate(script_.program->stages[0].show, 0);
    script_.program->literals->number_of(SurfaceValue{Function::distance, {0.5, 0, 0.5}});
    Formula late;
    Node node;
    node.kind = NodeKind::surface_value;
    node.index = 1;
    late.nodes.push_back(node);
    const auto below = simulation->evaluate(late, 0);
    const auto top = cell_values(shown[0], *simulation->model());
    const auto bottom = cell_values(below[0], *simulation->model());
    for (std::size_t k = 0; k < top.size(); ++k) EXPECT_NEAR(top[k] + bottom[k], pi / 2, 0.05);
}

/// A square of two triangles with texture coordinates and an attribute that is x.
constexpr const char* painted_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
constexpr const char* square_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "property float heat\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0\n1 0 0 10\n1 1 0 10\n0 1 0 0\n3 0 1 2\n3 0 2 3\n";

TEST_F(SurfaceValuesTest, AttributesAreLinearBetweenPoints) {
    std::ofstream(path("square.ply")) << square_ply;
    const auto found = values("mesh: \"square.ply\"; cells: 60", "attr(\"heat\")");
    ASSERT_EQ(found.size(), 60u);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], 10 * place(k).x, 1e-4);
}

TEST_F(SurfaceValuesTest, APaintedPictureLiesWhereTheTextureSays) {
    std::ofstream(path("square.obj")) << painted_obj;
    // Black on the left, white on the right; black below the middle.
    Image image(4, 4);
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 4; ++i) {
            const float shade = i >= 2 && j < 2 ? 1.0F : 0.0F;
            image.at(i, j) = {shade, shade, shade};
        }
    }
    ASSERT_TRUE(write_png(path("coat.png"), image, PngDepth::eight, {}));
    const auto found = values("mesh: \"square.obj\"; cells: 200", "uvimage(\"coat.png\")");
    ASSERT_EQ(found.size(), 200u);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Vector3d at = place(k);
        if (at.x > 0.625 && at.x < 0.875 && at.y > 0.625 && at.y < 0.875) {
            EXPECT_NEAR(found[k], 1, 1e-5);
        }
        if (at.x > 0.125 && at.x < 0.375) {
            EXPECT_NEAR(found[k], 0, 1e-5);
        }
        if (at.y > 0.625 && at.y < 0.875 && at.x > 0.4 && at.x < 0.6) {
            EXPECT_NEAR(found[k], 4 * (at.x - 0.375), 1e-4);
        }
    }
}

TEST_F(SurfaceValuesTest, WhatAModelDoesNotHave) {
    std::ofstream(path("square.ply")) << square_ply;
    const std::string square = "mesh: \"square.ply\"; cells: 60";
    EXPECT_NE(fault(square, "a: attr(\"heet\")\n").find("the model's points have no 'heet'"),
              std::string::npos);
    EXPECT_NE(script_.messages(false).find("did you mean 'heat'?"), std::string::npos);
    EXPECT_NE(fault(square, "a: attr(\"luminosity\")\n").find("they have heat"), std::string::npos);
    EXPECT_NE(fault("surface: sphere; cells: 60", "a: attr(\"heat\")\n")
                  .find("they have places and nothing else"),
              std::string::npos);
    Image image(2, 2);
    ASSERT_TRUE(write_png(path("coat.png"), image, PngDepth::eight, {}));
    EXPECT_NE(
        fault(square, "a: uvimage(\"coat.png\")\n").find("the model has no texture coordinates"),
        std::string::npos);
    EXPECT_NE(fault(square, "a: uvimage(\"none.png\")\n").find("none.png"), std::string::npos);
}

/// The mean over all links of (across / along)² weights: how much faster heat goes along y than
/// around, as the second moment of the weights in the two directions.
double speed_along_y(const ModelCells& model) {
    double along = 0, across = 0;
    for (std::size_t cell = 0; cell < model.count(); ++cell) {
        const Vector3d here = position_of(model.mesh, model.cells.places[cell]);
        for (const VoronoiEdge& edge : model.cells.edges_of(cell)) {
            const Vector3d there = position_of(model.mesh, model.cells.places[edge.neighbour]);
            const Vector3d way = there - here;
            along += edge.weight() * way.y * way.y;
            across += edge.weight() * (way.x * way.x + way.z * way.z);
        }
    }
    return along / across;
}

// A tower: nearly all of it is four upright walls.
const std::string tower = "surface: box(1, 8, 1); cells: 700; ";

TEST_F(SurfaceValuesTest, HeatGoesFasterAlongTheDirections) {
    const auto speed = [&](const std::string& settings) {
        const auto simulation = start(tower + settings);
        return simulation ? speed_along_y(*simulation->model()) : 0;
    };
    const double same = speed("");
    // Diffusion is three times as fast along and a third of it across.
    const double axis = speed("directions: axis(0, 1, 0); stretch: 3");
    EXPECT_GT(same, 0.7);
    EXPECT_LT(same, 1.3);
    EXPECT_GT(axis / same, 6);
    EXPECT_LT(axis / same, 12);
    EXPECT_NEAR(speed("directions: gradient(y); stretch: 3") / axis, 1, 0.1);
    EXPECT_NEAR(
        speed("directions: keys(0.5, 0.2, 0.5, 0, 1, 0, 0.5, 0.8, 0.5, 0, 2, 0); stretch: 3") /
            axis,
        1, 0.25);
    EXPECT_LT(speed("directions: axis(0, 1, 0)") / axis, 0.7);
}

TEST_F(SurfaceValuesTest, SpotsAreStretchedAlongTheDirections) {
    // What part of the squared gradient is upright: a half where spots are round, and where they
    // are three times as long as wide a tenth.
    const auto upright_part = [&](const std::string& settings) {
        const auto simulation = start(
            "surface: box(4, 8, 0.5); cells: 2500; " + settings,
            "iterations: 1000\nka: 1/20\nbeta: random(12, 0.5)\n"
            "show: mean(dy(b)^2 over domain) / mean(dx(b)^2 + dy(b)^2 + dz(b)^2 over domain)\n");
        if (!simulation) return 0.0;
        RunControl control;
        EXPECT_TRUE(simulation->advance_stage(
            0, 1000, control, [] {}, 1000));
        const Field part = std::move(simulation->evaluate(script_.program->stages[0].show, 0)[0]);
        return part.number_at(0, 0);
    };
    const double round = upright_part("");
    EXPECT_NEAR(round, 0.5, 0.08);
    const double along = upright_part("directions: axis(0, 1, 0); stretch: 3");
    EXPECT_NEAR(along, 0.1, 0.04);
}

TEST_F(SurfaceValuesTest, CurvatureSaysADirection) {
    const auto speed = [&](const std::string& settings) {
        const auto simulation = start("surface: torus(1, 0.15); cells: 700; " + settings);
        if (!simulation) return 0.0;
        const ModelCells& model = *simulation->model();
        double along = 0, all = 0;
        for (std::size_t cell = 0; cell < model.count(); ++cell) {
            const Vector3d here = position_of(model.mesh, model.cells.places[cell]);
            const Vector3d around = unit(Vector3d{-here.z, 0, here.x});
            for (const VoronoiEdge& edge : model.cells.edges_of(cell)) {
                const Vector3d way =
                    position_of(model.mesh, model.cells.places[edge.neighbour]) - here;
                along += edge.weight() * dot(way, around) * dot(way, around);
                all += edge.weight() * dot(way, way);
            }
        }
        return along / all;
    };
    // The ring is longest around, where curvature is low.
    const double low = speed("directions: curvature_low; stretch: 3");
    const double high = speed("directions: curvature_high; stretch: 3");
    EXPECT_GT(low, 0.8);
    EXPECT_LT(high, 0.2);
}

}  // namespace
}  // namespace cascade
