// Files of runs on models: what the ending of a name chooses, what pictures carry, and that the
// public library gives the cells as one row.
#include "cascade/cascade.h"
#include "core/file_format.h"
#include "run/commands/run_checks.h"
#include "run/pictures/model_files.h"
#include "run/pictures/painter.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using testing::ElementsAre;

TEST(ModelFiles, the_ending_says_what_a_file_holds) {
    for (const char* name : {"a.png", "b/c.PNG", "a.cells.png"}) {
        EXPECT_EQ(output_kind(name), FormatKind::picture) << name;
    }
    for (const char* name : {"a.gif", "a.WebP", "a.apng", "a.mp4", "a.cells.webm"}) {
        EXPECT_EQ(output_kind(name), FormatKind::film) << name;
    }
    for (const char* name : {"a.ply", "a.Obj", "a.glb", "a.vtp", "cells.vtp", "a.cells.b.vtp"}) {
        EXPECT_EQ(output_kind(name), FormatKind::model) << name;
    }
    for (const char* name : {"a.svg", "a.PDF"}) {
        EXPECT_EQ(output_kind(name), FormatKind::figure) << name;
    }
    for (const char* name : {"a.npz", "a.cells.vtp", "b/a.Cells.VTP"}) {
        EXPECT_EQ(output_kind(name), FormatKind::cells) << name;
    }
    for (const char* name :
         {"a", "", "png", "gif", "a.fbx", "a.vti", "a.json", "a.png.bak", ".ply", "a."}) {
        EXPECT_FALSE(output_kind(name)) << name;
    }
}

TEST(ModelFiles, only_glb_files_are_baked) {
    const ModelFileOptions plain, baked{false, 64};
    EXPECT_TRUE(baked.is_baked("a.GLB"));
    EXPECT_FALSE(baked.is_baked("a.ply"));
    EXPECT_FALSE(plain.is_baked("a.glb"));
}

TEST(ModelFiles, a_turntable_numbers_its_pictures) {
    EXPECT_THAT(turntable_paths("a/horse.png", 2),
                ElementsAre("a/horse-001.png", "a/horse-002.png"));
    EXPECT_EQ(turntable_paths("horse.png", 1200)[6], "horse-0007.png");
}

TEST(ModelFiles, pictures_carry_how_a_model_is_seen) {
    PictureRequest request;
    EXPECT_EQ(to_json(request).find("bump"), std::string::npos);
    request.bump = -0.25F;
    request.view = {200, -10, {0, 0, 1}, true};
    request.size = PictureSize{1920, 1080};
    request.copies = {3, 2};
    request.quality = Quality::fine;
    request.lighting = Lighting::outdoors;
    request.displace = true;
    request.fov = 62.5F;
    request.ground = false;
    const auto back = picture_request_from_json(to_json(request));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->bump, -0.25F);
    EXPECT_TRUE(back->view.is_turning);
    EXPECT_EQ(back->view.azimuth, 200.0F);
    EXPECT_EQ(back->size, request.size);
    EXPECT_EQ(back->copies, request.copies);
    EXPECT_EQ(back->quality, Quality::fine);
    EXPECT_EQ(back->lighting, Lighting::outdoors);
    EXPECT_TRUE(back->displace);
    EXPECT_EQ(back->fov, 62.5F);
    EXPECT_FALSE(back->ground);
    EXPECT_EQ(to_json({}).find("fov"), std::string::npos);
    EXPECT_EQ(to_json({}).find("background"), std::string::npos);
    for (const auto& background : {std::optional<Colour>(), std::optional(Colour{1, 0.2F, 0})}) {
        request.background = background;
        const auto kept = picture_request_from_json(to_json(request));
        ASSERT_TRUE(kept);
        EXPECT_EQ(kept->background, background);
    }
    for (const char* wrong :
         {R"({"bump": 2})", R"({"bump": "a"})", R"({"turning": 3})", R"({"size": [0, 9]})",
          R"({"size": [9]})", R"({"copies": [2, 0]})", R"({"size": 9})", R"({"quality": "best"})",
          R"({"quality": 1})", R"({"light": "moon"})", R"({"fov": 0})", R"({"fov": "a"})",
          R"({"ground": 2})", R"({"background": "blue"})", R"({"background": null})"}) {
        EXPECT_FALSE(picture_request_from_json(wrong)) << wrong;
    }
}

TEST(ModelFiles, the_library_has_the_cells_in_one_row) {
    Pattern pattern(
        "domain { surface: sphere; cells: 700 }\n"
        "stage s: turing_spots { iterations: 4 }\n",
        {false, 1, "s", "."});
    ASSERT_TRUE(pattern.ok()) << pattern.messages() << pattern.error();
    EXPECT_EQ(pattern.width(), 700);
    EXPECT_EQ(pattern.height(), 1);
    EXPECT_EQ(pattern.step(9), 4);
    EXPECT_EQ(pattern.values("a").size(), 700u);
}

}  // namespace
}  // namespace cascade
