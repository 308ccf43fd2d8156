// Painted pictures on a model, and cells stretched along directions. Other values that cells get
// from their places on a model are tested in tests/scripts/models.
#include "picture/image.h"
#include "run/domain/model_cells.h"
#include "run/simulation/simulation.h"
#include "run_fixture.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace cascade {
namespace {

class SurfaceValuesTest : public RunTest {
protected:
    /// The simulation of a script whose only stage has begun. Null if this fails, which also fails
    /// the test.
    std::unique_ptr<Simulation> start(const std::string& domain,
                                      const std::string& statements = "") {
        script_ = load("domain { " + domain + " }\nsystem_name: turing_spots\n" + statements);
        EXPECT_EQ(script_.messages(false), "");
        if (!script_.program) return nullptr;
        SimulationOptions options;
        options.backend = "interp";
        auto made = Simulation::create(script_, options);
        EXPECT_TRUE(made) << script_.messages(false);
        if (!made || !(*made)->start_stage(0)) return nullptr;
        return *std::move(made);
    }

    /// The values of an expression in each cell, read from the starting values of `a`.
    std::vector<double> values(const std::string& domain, const std::string& expression) {
        const auto simulation = start(domain, "a: " + expression + "\n");
        if (!simulation) return {};
        model_ = simulation->domain().shared_model();
        return cell_values(simulation->state(0).species()[0], *model_);
    }

    /// The place of a cell, 0 … 1.
    Vector3d place(std::size_t cell) const {
        const ModelBox box(model_->mesh);
        return box.in_script(position_of(model_->mesh, model_->spread().cells.places[cell]));
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

/// A square of two triangles with texture coordinates.
constexpr const char* painted_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

TEST_F(SurfaceValuesTest, APaintedPictureLiesWhereTheTextureSays) {
    std::ofstream(path("square.obj")) << painted_obj;
    // The upper half is black on the left and white on the right. The lower half is black.
    Image image(4, 4);
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 4; ++i) {
            const float shade = i >= 2 && j < 2 ? 1.0F : 0.0F;
            image.at(i, j) = {shade, shade, shade};
        }
    }
    ASSERT_TRUE(write_png(path("coat.png"), image, PngDepth::eight, {}));
    const auto found = values("mesh: \"square.obj\"; cells: 200", "image(\"coat.png\")");
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

TEST_F(SurfaceValuesTest, APaintedPictureNeedsTextureCoordinates) {
    std::ofstream(path("square.off")) << "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    ASSERT_TRUE(write_png(path("coat.png"), Image(2, 2), PngDepth::eight, {}));
    EXPECT_NE(fault("mesh: \"square.off\"; cells: 60", "a: image(\"coat.png\")\n")
                  .find("the model has no texture coordinates"),
              std::string::npos);
    EXPECT_NE(script_.messages(false).find("cascade mesh square.off --unwrap"), std::string::npos);
}

/// A picture of 2 × 2 pixels with these colours, row by row.
Image four(Colour a, Colour b, Colour c, Colour d) {
    Image image(2, 2);
    image.at(0, 0) = a;
    image.at(1, 0) = b;
    image.at(0, 1) = c;
    image.at(1, 1) = d;
    return image;
}

TEST_F(SurfaceValuesTest, APlaceSaysWhereInAPicture) {
    // Red grows to the right, blue downwards.
    ASSERT_TRUE(write_png(path("map.png"), four({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}),
                          PngDepth::eight, {}));
    const auto between = [](double at) { return std::clamp(2 * at - 0.5, 0.0, 1.0); };
    const std::string ball = "surface: sphere; cells: 300";
    for (const double part : {1.0, 3.0}) {
        const std::string across = part == 1 ? "sx" : "3 * sx - 1";
        const auto red = values(ball, "image(\"map.png\", \"red\", " + across + ", 1 - sy)");
        const auto blue = values(ball, "image(\"map.png\", \"blue\", " + across + ", 1 - sy)");
        ASSERT_EQ(red.size(), 300u);
        for (std::size_t k = 0; k < red.size(); ++k) {
            const double x = part == 1 ? place(k).x : 3 * place(k).x - 1;
            EXPECT_NEAR(red[k], between(x), 1e-5);
            EXPECT_NEAR(blue[k], between(1 - place(k).y), 1e-5);
        }
    }
}

/// A ball of radius 8 in the middle of 24 × 24 × 24 cells, and a bar of 12 × 6 × 6 cells, which the
/// sides of its array close.
TEST_F(SurfaceValuesTest, AVolumeGivesTheSurfaceOfAModel) {
    Field ball{PlaneLayout(Grid{24, 24, {}, 24})}, bar{PlaneLayout(Grid{12, 6, {}, 6})};
    for (std::int64_t k = 0; k < 24; ++k) {
        for (std::int64_t j = 0; j < 24; ++j) {
            for (std::int64_t i = 0; i < 24; ++i) {
                const auto from_middle = [](std::int64_t n) {
                    return static_cast<double>(n) - 11.5;
                };
                ball.at(i, j, k) = static_cast<float>(
                    8 - std::hypot(from_middle(i), from_middle(j), from_middle(k)));
                if (i < 12 && j < 6 && k < 6) bar.at(i, j, k) = 3;
            }
        }
    }
    ASSERT_TRUE(write_npy(path("ball.npy"), ball));
    ASSERT_TRUE(write_npy(path("bar.npy"), bar));
    const std::string places[] = {"field(\"ball.npy\")",
                                  "field(\"ball.npy\", 0.5 + x / 4, 0.5 + y / 4, 0.5 + z / 4)"};
    for (const std::string& read : places) {
        const auto found = values("surface: implicit(" + read + ", 2); cells: 300",
                                  "sqrt((x - 0.5)^2 + (y - 0.5)^2 + (z - 0.5)^2)");
        ASSERT_EQ(found.size(), 300u);
        for (const double radius : found) EXPECT_NEAR(radius, 0.5, 0.01) << read;
    }
    const auto heights = values("surface: implicit(field(\"bar.npy\") - 1); cells: 300", "y");
    EXPECT_NEAR(*std::ranges::max_element(heights), 0.5, 0.04);
    EXPECT_NE(
        fault("surface: implicit(field(\"none.npy\")); cells: 300", "a: 1\n").find("none.npy"),
        std::string::npos);
}

TEST_F(SurfaceValuesTest, APlaceSaysWhereInAnArray) {
    Field volume{PlaneLayout(Grid{2, 2, {}, 2})};
    volume.at(1, 0, 0) = volume.at(1, 1, 0) = volume.at(1, 0, 1) = volume.at(1, 1, 1) = 3;
    for (std::int64_t j : {0, 1}) {
        for (std::int64_t i : {0, 1}) volume.at(i, j, 1) += 10;
    }
    ASSERT_TRUE(write_npy(path("volume.npy"), volume));
    const auto between = [](double at) { return std::clamp(2 * at - 0.5, 0.0, 1.0); };
    const std::string ball = "surface: sphere; cells: 300";
    const auto found = values(ball, "field(\"volume.npy\", x, y, z)");
    ASSERT_EQ(found.size(), 300u);
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], 3 * between(place(k).x) + 10 * between(place(k).z), 1e-4);
    }
    EXPECT_NE(fault(ball, "a: field(\"volume.npy\", sx, sy)\n").find("has 2 slices"),
              std::string::npos);
}

TEST_F(SurfaceValuesTest, APaintedDirectionIsAnAngleOnTheSurface) {
    // All pixels point 30 degrees upwards from the right.
    const Colour painted{0.5F + 0.5F * std::cos(0.5236F), 0.5F + 0.5F * std::sin(0.5236F), 0};
    ASSERT_TRUE(write_png(path("flow.png"), four(painted, painted, painted, painted),
                          PngDepth::sixteen, {}));
    std::ofstream(path("square.obj")) << painted_obj;
    // On a square that faces its viewer angles turn from right to down, so upwards is negative.
    for (const double angle :
         values("mesh: \"square.obj\"; cells: 60", "along(image(\"flow.png\"))")) {
        EXPECT_NEAR(angle, -0.5236, 1e-3);
    }
    // Read at the cell's own place, the picture gives the same angle. Mirrored, it points to the
    // left, and stretched to twice the width, it is flatter.
    for (const auto& [place, expected] :
         {std::pair("sx, 1 - sy", -0.5236), std::pair("1 - sx, 1 - sy", -3.14159 + 0.5236),
          std::pair("sx / 2, 1 - sy", -std::atan2(std::sin(0.5236), 2 * std::cos(0.5236)))}) {
        const auto angles = values("mesh: \"square.obj\"; cells: 60",
                                   "along(image(\"flow.png\", " + std::string(place) + "))");
        ASSERT_EQ(angles.size(), 60u);
        for (const double angle : angles) EXPECT_NEAR(angle, expected, 1e-3) << place;
    }
    // Middle grey means no direction, and gives the angle 0.
    const Colour grey{0.5F, 0.5F, 0.5F};
    ASSERT_TRUE(write_png(path("flow.png"), four(grey, grey, grey, grey), PngDepth::eight, {}));
    for (const double angle :
         values("mesh: \"square.obj\"; cells: 60", "along(image(\"flow.png\"))")) {
        EXPECT_EQ(angle, 0);
    }
}

/// How much faster heat spreads along y than across: the quotient of the second moments of all
/// links' weights in the two directions.
double speed_along_y(const ModelCells& model) {
    double along = 0, across = 0;
    for (std::size_t cell = 0; cell < model.count(); ++cell) {
        const Vector3d here = position_of(model.mesh, model.spread().cells.places[cell]);
        for (const VoronoiEdge& edge : model.spread().cells.edges_of(cell)) {
            const Vector3d there =
                position_of(model.mesh, model.spread().cells.places[edge.neighbour]);
            const Vector3d way = there - here;
            along += edge.weight() * way.y * way.y;
            across += edge.weight() * (way.x * way.x + way.z * way.z);
        }
    }
    return along / across;
}

// A tower, whose surface is nearly all in four upright walls.
const std::string tower = "surface: box(1, 8, 1); cells: 700; ";

TEST_F(SurfaceValuesTest, HeatGoesFasterAlongTheDirections) {
    const auto speed = [&](const std::string& settings) {
        const auto simulation = start(tower + settings);
        return simulation ? speed_along_y(*simulation->domain().model->cells) : 0;
    };
    const double same = speed("");
    // Diffusion is three times as fast along the direction, and a third as fast across.
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

TEST_F(SurfaceValuesTest, CurvatureSaysADirection) {
    const auto speed = [&](const std::string& settings) {
        const auto simulation = start("surface: torus(1, 0.15); cells: 700; " + settings);
        if (!simulation) return 0.0;
        const ModelCells& model = *simulation->domain().model->cells;
        double along = 0, all = 0;
        for (std::size_t cell = 0; cell < model.count(); ++cell) {
            const Vector3d here = position_of(model.mesh, model.spread().cells.places[cell]);
            const Vector3d around = unit(Vector3d{-here.z, 0, here.x});
            for (const VoronoiEdge& edge : model.spread().cells.edges_of(cell)) {
                const Vector3d way =
                    position_of(model.mesh, model.spread().cells.places[edge.neighbour]) - here;
                along += edge.weight() * dot(way, around) * dot(way, around);
                all += edge.weight() * dot(way, way);
            }
        }
        return along / all;
    };
    // Curvature is low along the ring, around which the way is longest.
    const double low = speed("directions: curvature_low; stretch: 3");
    const double high = speed("directions: curvature_high; stretch: 3");
    EXPECT_GT(low, 0.8);
    EXPECT_LT(high, 0.2);
}

}  // namespace
}  // namespace cascade
