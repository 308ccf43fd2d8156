// Volumes that are drawn as bodies: their surfaces, compared with theory, and pictures, frames and
// files.
#include "run/pictures/body_picture.h"

#include "export/model_writer.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "run/pictures/grid_files.h"
#include "run/pictures/frames.h"
#include "run/pictures/painter.h"
#include "run/session/turns.h"
#include "tests/support/never.h"
#include "unit/run/ran_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace cascade {
namespace {

/// A script whose u is the depth of a place below the surface of a ball of radius 0.3.
std::string ball(const std::string& picture, const std::string& domain = "") {
    return "domain { grid: 24, 24, 24; boundary: noflux; " + domain + " }\n" +
           "system ball { u: 0.3 - sqrt((x - 0.5)^2 + (y - 0.5)^2 + (z - 0.5)^2); u' = 0 }\n"
           "stage grown: ball { iterations: 1 }\n"
           "picture { " +
           picture + " }\n";
}

struct Drawn {
    Ran ran;
    Result<Painter> painter;
    Canvas canvas;

    explicit Drawn(const std::string& text, PictureRequest request = {})
        : ran(run_text(text)), painter(Painter::create(ran.script, request)) {
        request.view.azimuth = request.view.elevation = 0;
        painter->set_view(request.view);
        canvas = painter->canvas(*ran.simulation);
    }
    Image image() { return painter->image(canvas); }
};

double volume_of(const SurfaceMesh& mesh) {
    double six = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        six += dot(mesh.corner(t, 0), cross(mesh.corner(t, 1), mesh.corner(t, 2)));
    }
    return six / 6;
}

bool is_closed(const SurfaceMesh& mesh) { return facts_of(mesh).boundary_edges == 0; }

TEST(BodyPicture, HasTheAreaAndVolumeOfABall) {
    const Drawn drawn(ball("body: u; color: rgb(x, y, z)"));
    ASSERT_TRUE(drawn.canvas.body);
    const SurfaceMesh& body = *drawn.canvas.body;
    EXPECT_TRUE(is_closed(body));
    EXPECT_EQ(facts_of(body).euler_characteristic, 2);
    using std::numbers::pi;
    EXPECT_NEAR(body.total_area(), 4 * pi * 0.09, 0.02 * 4 * pi * 0.09);
    EXPECT_NEAR(volume_of(body), 4 * pi * 0.027 / 3, 0.02 * 4 * pi * 0.027 / 3);
    // Each point of the surface has the field's values at its own place.
    for (std::size_t k = 0; k < body.points.size(); ++k) {
        const auto n = static_cast<std::int64_t>(k);
        ASSERT_NEAR(drawn.canvas.fields[0].at(n, 0), body.points[k].x, 1e-5);
        ASSERT_NEAR(drawn.canvas.fields[2].at(n, 0), body.points[k].z, 1e-5);
    }
}

TEST(BodyPicture, IsClosedBySidesAndMasks) {
    // The body is one half of the box.
    const Drawn half(ball("body: 0.5 - x"));
    EXPECT_TRUE(is_closed(*half.canvas.body));
    EXPECT_NEAR(volume_of(*half.canvas.body), 0.5, 0.01);
    const Drawn masked(ball("body: 1", "mask: box(0.5, 0.5, 0.5, 0.5, 0.5, 0.5)"));
    EXPECT_TRUE(is_closed(*masked.canvas.body));
    EXPECT_NEAR(volume_of(*masked.canvas.body), 0.125, 0.02);
}

TEST(BodyPicture, ShowsWhereItIs) {
    Drawn drawn(ball("body: u; color: if(z > 0.5, rgb(1, 0, 0), rgb(0, 0, 1))"));
    const Image image = drawn.image();
    EXPECT_EQ(image.width, 800);
    const std::int64_t x = image.width / 2, y = image.height / 2, away = image.height / 5;
    const Colour above = image.at(x, y - away), below = image.at(x, y + away);
    EXPECT_GT(above[0], 2 * above[2]) << "z is upwards";
    EXPECT_GT(below[2], 2 * below[0]);
    PictureRequest flat;
    flat.flat = true;
    EXPECT_EQ(Drawn(ball("body: u"), flat).image().width, 24);
    PictureRequest slice;
    slice.slice.place = 0.2;
    EXPECT_EQ(Drawn(ball("body: u"), slice).image().width, 24);
}

TEST(BodyPicture, IsEmptyWhereNothingIsInside) {
    Drawn drawn(ball("body: u - 1"));
    EXPECT_TRUE(drawn.canvas.body->points.empty());
    EXPECT_EQ(drawn.image().width, 800);
    const auto path = std::filesystem::path(::testing::TempDir()) / "empty.ply";
    const auto written = write_body(path, *drawn.canvas.body, Grid{24, 24}, {}, 1);
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("the body is empty"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(BodyPicture, IsTheSameInFrames) {
    Drawn drawn(ball("body: u"));
    auto frames = FrameRecorder::create(true, false);
    ASSERT_TRUE(frames);
    frames->record(drawn.canvas, "grown", 1);
    const Image expected = drawn.image();
    const std::size_t number = 0;
    std::size_t seen = 0;
    const auto drawn_again =
        frames->draw(*drawn.painter, {&number, 1}, 1, test::never,
                     [&](std::size_t, const Image& image) -> Result<FrameRecorder::InOrder> {
                         EXPECT_EQ(image.pixels, expected.pixels);
                         ++seen;
                         return [] { return Result<void>(); };
                     });
    EXPECT_TRUE(drawn_again);
    EXPECT_EQ(seen, 1U);
}

/// The page of `cascade view` shows slices.
TEST(BodyPicture, LeavesSnapshotsOfSessionsTheirCells) {
    Script script = load_script("test", ball("body: u; color: rgb(1, x, 0)"), ".");
    RunControl control;
    auto run = LiveRun::begin(std::move(script), {"interp", 0, 1}, control);
    ASSERT_TRUE(run);
    Turns turns(std::move(*run));
    for (const char* const shown : {"", "u"}) {
        ASSERT_TRUE(turns.obey(Show{shown}));
        const auto snapshot = turns.snapshot();
        ASSERT_TRUE(snapshot);
        EXPECT_EQ(snapshot->fields[0].layout().width, 24);
        EXPECT_EQ(snapshot->fields[0].layout().height, 24);
    }
}

TEST(BodyPicture, IsWrittenInUnitsOfTheGrid) {
    const Drawn drawn(ball("body: u", "spacing: 0.5"));
    const auto path = std::filesystem::path(::testing::TempDir()) / "ball.stl";
    const Grid grid = drawn.ran.simulation->domain().grid;
    ASSERT_TRUE(write_body(path, *drawn.canvas.body, grid, {}, 1));
    auto soup = read_model(path);
    ASSERT_TRUE(soup) << soup.error().message;
    const auto read = make_mesh(*std::move(soup));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(is_closed(read->mesh));
    const auto [low, high] = read->mesh.box();
    EXPECT_NEAR(low.x, 12 * 0.2, 0.05);
    EXPECT_NEAR(high.z, 12 * 0.8, 0.05);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace cascade
