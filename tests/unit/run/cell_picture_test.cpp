// Pictures of cells on surfaces.
#include "run/pictures/cell_picture.h"

#include "picture/srgb.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cascade::test {
namespace {

DrawOptions small_picture(std::int64_t side) {
    DrawOptions options;
    options.width = options.height = side;
    options.view = {0, 0, {0, 0, 1}};
    options.ground = false;
    return options;
}

/// A surface with its cells and everything else that drawing needs.
struct Scene {
    SurfaceMesh mesh;
    SurfaceCells cells;
    Team team;
    CellScene scene;

    Scene(SurfaceMesh surface, std::size_t count, int threads = 2)
        : mesh(std::move(surface)),
          cells(cells_of(mesh, count)),
          team(threads),
          scene(mesh, cells, team) {}

    template <typename Function>
    std::vector<float> values(Function function) const {
        std::vector<float> result;
        for (const SurfacePlace& place : cells.places) {
            result.push_back(static_cast<float>(function(position_of(mesh, place))));
        }
        return result;
    }
};

Colour grey(std::span<const float> values, const SurfacePlace&) {
    return {values[0], values[0], values[0]};
}

Colour black_or_white(std::span<const float> values, const SurfacePlace&) {
    const float shade = values[0] > 0 ? 1.0F : 0.0F;
    return {shade, shade, shade};
}

/// The mean of red + green + blue over all pixels that are not background.
double mean_light(const Image& image) {
    double sum = 0;
    for (const Colour& pixel : image.pixels) {
        for (const float channel : pixel) sum += static_cast<double>(light_of(channel));
    }
    return sum / static_cast<double>(3 * image.pixels.size());
}

TEST(CellPicture, ASphereIsLitFromTheLeft) {
    Scene sphere_scene(sphere(8), 500);
    const std::vector<float> values(500, 0.5F);
    const Image image =
        sphere_scene.scene.draw({1, values, grey, {}}, small_picture(100), sphere_scene.team);
    EXPECT_GT(image.at(35, 30)[0], image.at(70, 70)[0] + 0.1F);
    EXPECT_GT(image.at(1, 1)[0], 0.999F);
}

TEST(CellPicture, ColoursAreWhereTheCellsAre) {
    Scene cube(box(), 800);
    // Seen from −y, x grows to the right, so the right is red and the left is blue.
    const std::vector<float> values = cube.values([](Vector3d p) { return p.x; });
    const auto colour = [](std::span<const float> v, const SurfacePlace&) -> Colour {
        return v[0] > 0.5F ? Colour{0.8F, 0, 0} : Colour{0, 0, 0.8F};
    };
    const Image image = cube.scene.draw({1, values, colour, {}}, small_picture(100), cube.team);
    EXPECT_GT(image.at(30, 50)[2], image.at(30, 50)[0] + 0.2F);
    EXPECT_GT(image.at(70, 50)[0], image.at(70, 50)[2] + 0.2F);
}

TEST(CellPicture, ACubeHasEdgesAndASphereHasNone) {
    const DrawnMesh cube = creased_mesh(box());
    EXPECT_EQ(cube.mesh.positions.size(), 24u);
    for (std::size_t t = 0; t < 12; ++t) {
        for (const std::uint32_t corner : cube.mesh.triangles[t]) {
            const Vector3 n = cube.mesh.normals[corner];
            EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
        }
    }
    const SurfaceMesh ball = sphere(6);
    EXPECT_EQ(creased_mesh(ball).mesh.positions.size(), ball.points.size());
}

TEST(CellPicture, BumpsAreLitFromTheLeftToo) {
    Scene flat(square(), 3000);
    // A ridge along y in the middle of the square, seen from above.
    const std::vector<float> values(3000, 0.5F);
    const std::vector<float> heights =
        flat.values([](Vector3d p) { return 0.05 * std::exp(-100 * (p.x - 0.5) * (p.x - 0.5)); });
    DrawOptions options = small_picture(100);
    options.view = {0, 89, {0, 0, 1}};
    const Image plain = flat.scene.draw({1, values, grey, {}}, options, flat.team);
    const Image bumpy = flat.scene.draw({1, values, grey, heights}, options, flat.team);
    const auto mean_of_column = [](const Image& image, std::int64_t x) {
        double sum = 0;
        for (std::int64_t y = 30; y < 70; ++y) sum += static_cast<double>(image.at(x, y)[0]);
        return sum / 40;
    };
    // The left slope of the ridge faces the sun, the right one does not, and far from the ridge
    // nothing has changed.
    EXPECT_GT(mean_of_column(bumpy, 44), mean_of_column(plain, 44) + 0.01);
    EXPECT_LT(mean_of_column(bumpy, 56), mean_of_column(plain, 56) - 0.03);
    EXPECT_NEAR(mean_of_column(bumpy, 15), mean_of_column(plain, 15), 0.002);
}

TEST(CellPicture, RaisedSurfacesHaveTheLastHeights) {
    Scene ball(sphere(8), 500);
    const std::vector<float> values(500, 0.5F);
    const auto drawn = [&](Scene& scene, float height) {
        const std::vector<float> heights =
            scene.values([&](Vector3d p) { return p.x > 0 ? static_cast<double>(height) : 0; });
        PaintedCells look{1, values, grey, heights};
        look.displaces = true;
        return scene.scene.draw(look, small_picture(30), scene.team).pixels;
    };
    const auto low = drawn(ball, 0.05F), high = drawn(ball, 0.3F);
    EXPECT_NE(low, high);
    EXPECT_EQ(drawn(ball, 0.3F), high);
    EXPECT_EQ(drawn(ball, 0.05F), low);
}

TEST(CellPicture, FarViewsKeepTheirLight) {
    Scene ball(sphere(20), 20'000);
    // Stripes three cells wide, most of them black.
    const std::vector<float> values =
        ball.values([](Vector3d p) { return std::sin(60 * p.z) - 0.5; });
    const PaintedCells look = {1, values, black_or_white, {}};
    const double near = mean_light(ball.scene.draw(look, small_picture(256), ball.team));
    for (const std::int64_t side : {64, 24, 8}) {
        const double far = mean_light(ball.scene.draw(look, small_picture(side), ball.team));
        EXPECT_NEAR(far, near, 0.03 * near) << side;
    }
}

TEST(CellPicture, FarViewsDoNotShimmer) {
    Scene ball(sphere(20), 20'000);
    // The squares of this pattern are much smaller than pixels, so turning the sphere a little
    // changes nothing.
    const std::vector<float> values = ball.values([](Vector3d p) {
        return std::sin(50 * p.x) * std::sin(50 * p.y) * std::sin(50 * p.z) > 0 ? 1 : -1;
    });
    const PaintedCells look = {1, values, black_or_white, {}};
    DrawOptions options = small_picture(8);
    const Image first = ball.scene.draw(look, options, ball.team);
    options.view.azimuth = 3;
    const Image second = ball.scene.draw(look, options, ball.team);
    float largest = 0;
    for (std::int64_t y = 3; y < 5; ++y) {
        for (std::int64_t x = 3; x < 5; ++x) {
            largest = std::max(largest, std::abs(first.at(x, y)[0] - second.at(x, y)[0]));
        }
    }
    EXPECT_LT(largest, 0.08F);
}

TEST(CellPicture, NumbersThatAreNoneAreMagenta) {
    Scene ball(sphere(6), 300);
    std::vector<float> values(300, NAN);
    const std::vector<float> heights(300, INFINITY);
    for (const std::int64_t side : {8, 40}) {
        const Image image =
            ball.scene.draw({1, values, grey, heights}, small_picture(side), ball.team);
        const Colour& pixel = image.at(side / 2, side / 2);
        EXPECT_GT(pixel[0], pixel[1] + 0.2F);
        EXPECT_GT(pixel[2], pixel[1] + 0.2F);
    }
}

TEST(CellPicture, SizeDoesNotMatter) {
    const std::vector<float> values(200, 0.5F);
    std::vector<Image> images;
    for (const double scale : {1.0, 1e-40, 1e40}) {
        SurfaceMesh mesh = sphere(5);
        for (Vector3d& p : mesh.points) p = p * scale;
        Scene ball(std::move(mesh), 200);
        images.push_back(ball.scene.draw({1, values, grey, {}}, small_picture(40), ball.team));
    }
    for (const Image& image : images) {
        EXPECT_NEAR(image.at(14, 12)[0], images[0].at(14, 12)[0], 0.02);
        EXPECT_NEAR(image.at(25, 27)[0], images[0].at(25, 27)[0], 0.02);
    }
}

TEST(CellPicture, ThreadsDoNotMatter) {
    std::vector<Image> images;
    for (const int threads : {1, 2}) {
        Scene ball(sphere(10), 2000, threads);
        const std::vector<float> values = ball.values([](Vector3d p) { return std::sin(9 * p.x); });
        const std::vector<float> heights =
            ball.values([](Vector3d p) { return 0.1 * std::cos(8 * p.z); });
        DrawOptions options = small_picture(20);
        options.ground = true;
        images.push_back(ball.scene.draw({1, values, black_or_white, heights}, options, ball.team));
    }
    EXPECT_TRUE(images[0].pixels == images[1].pixels);
}

}  // namespace
}  // namespace cascade::test
