// Frames as bytes, the changed part of a frame, and how long frames are shown.
#include "film_fixture.h"

#include "film/colour_table.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

TEST(FilmFrames, AreRoundedAsPicturesAre) {
    Image image(2, 1);
    image.at(0, 0) = {0.2F, 2, -1};
    image.at(1, 0) = transparent;
    const FilmFrame frame = film_frame(image);
    EXPECT_EQ(frame.pixels, std::string("\x33\xff\x00\xff\xff\xff\xff\x00", 8));
    EXPECT_TRUE(has_holes(frame));
    EXPECT_TRUE(has_alpha(frame));
    EXPECT_FALSE(has_holes(disc_frame(9, 9, 4, 4)));
    EXPECT_FALSE(has_alpha(disc_frame(9, 9, 4, 4)));
}

TEST(FilmFrames, HaveTheOpacityOfPictures) {
    Image image(3, 1, {1, 0, 0});
    image.alpha = {0.8F, 0.5F, 0};
    FilmFrame frame = film_frame(image);
    EXPECT_EQ(frame.pixels, std::string("\xff\0\0\xcc\xff\0\0\x80\xff\xff\xff\0", 12));
    EXPECT_FALSE(is_hole(frame.row(0, 1)));
    EXPECT_TRUE(has_holes(frame));
    image.alpha[2] = 1;
    frame = film_frame(image);
    EXPECT_FALSE(has_holes(frame)) << "half opaque is seen in a GIF";
    EXPECT_TRUE(has_alpha(frame));
}

TEST(FilmFrames, ChangeInARectangle) {
    const FilmFrame before = film_frame(Image(9, 7));
    const auto changed_at = [&](std::vector<std::pair<int, int>> places) {
        Image image(9, 7);
        for (const auto& [x, y] : places) image.at(x, y) = {0, 1, 1};
        return changed_part(before, film_frame(image));
    };
    EXPECT_EQ(changed_at({{3, 2}}), (FramePart{3, 2, 1, 1}));
    EXPECT_EQ(changed_at({{3, 2}, {1, 5}, {6, 3}}), (FramePart{1, 2, 6, 4}));
    EXPECT_EQ(changed_at({{0, 0}, {8, 6}}), (FramePart{0, 0, 9, 7}));
    EXPECT_EQ(changed_at({}), (FramePart{0, 0, 1, 1}));
}

TEST(FilmFrames, AreShownForWholeTicksThatAddUp) {
    FrameTimes times(30, 100);
    std::int64_t sum = 0;
    for (int k = 0; k < 30; ++k) {
        const std::int64_t ticks = times.next();
        EXPECT_TRUE(ticks == 3 || ticks == 4);
        sum += ticks;
    }
    EXPECT_EQ(sum, 100);
}

TEST_F(FilmTest, HasSidesThatItsFormatHolds) {
    const auto refused = [&](const char* name, std::int64_t width, std::int64_t height) {
        const auto fits = check_film_size(path(name), width, height);
        return fits ? "" : fits.error().message;
    };
    EXPECT_EQ(refused("a.gif", 65535, 65535), "");
    EXPECT_THAT(refused("a.gif", 65536, 3),
                testing::HasSubstr("cannot hold frames of 65536 × 3 pixels: a side of GIF has at "
                                   "most 65535"));
    EXPECT_EQ(refused("a.webp", 16383, 1), "");
    EXPECT_THAT(refused("a.webp", 1, 16384), testing::HasSubstr("a side of WebP"));
    EXPECT_EQ(refused("a.apng", 70000, 70000), "");
    const std::vector<FilmFrame> wide = {film_frame(Image(16384, 1))};
    EXPECT_FALSE(begin_film(path("a.webp"), {}, wide));
    EXPECT_EQ(files(), 0U);
}

TEST(FewColours, AreChosenFromManyFrames) {
    const std::vector<FilmFrame> frames = {many_colours(0), many_colours(1)};
    EXPECT_FALSE(few_colours(frames[0], 256));
    const std::vector<PackedColour> chosen = chosen_colours(frames, 200);
    EXPECT_EQ(chosen.size(), 200U);
    NearestColours nearest(chosen);
    // A cube of colours in 200 parts: each is about 255 / 200^(1/3) = 44 wide.
    for (const PackedColour colour : {0x000000U, 0xff0000U, 0x8040ffU, 0x00c080U, 0xffff80U}) {
        const PackedColour found = nearest.table()[nearest(colour)];
        for (const int shift : {0, 8, 16}) {
            EXPECT_NEAR(colour >> shift & 0xff, found >> shift & 0xff, 60) << std::hex << colour;
        }
    }
    // With few colours, each is kept exactly.
    const std::vector<FilmFrame> disc = moving_disc();
    const std::vector<PackedColour> own = chosen_colours(disc, 256);
    EXPECT_TRUE(std::is_sorted(own.begin(), own.end()));
    const auto of_frame = few_colours(disc[2], 256);
    ASSERT_TRUE(of_frame);
    for (const PackedColour colour : *of_frame) {
        EXPECT_THAT(own, testing::Contains(colour));
    }
}

}  // namespace
}  // namespace cascade
