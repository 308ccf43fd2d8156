// GIF films, read by giflib and composed as by browsers.
#include "film_fixture.h"

#include <gif_lib.h>
#include <gmock/gmock.h>

#include <memory>

namespace cascade {
namespace {

struct ShownGif {
    std::vector<std::string> frames;  ///< Pixels in RGBA. Transparent pixels are white.
    std::vector<int> times;           ///< In hundredths of a second.
    std::vector<FramePart> parts;
    bool repeats = false;
};

const std::string hole("\xff\xff\xff\0", 4);

std::string colour_of(const GifColorType& colour) {
    return {static_cast<char>(colour.Red), static_cast<char>(colour.Green),
            static_cast<char>(colour.Blue), '\xff'};
}

ShownGif shown_gif(const std::filesystem::path& path) {
    ShownGif film;
    const auto close = [](GifFileType* gif) { DGifCloseFile(gif, nullptr); };
    int error = 0;
    const std::unique_ptr<GifFileType, decltype(close)> gif(DGifOpenFileName(path.c_str(), &error),
                                                            close);
    if (!gif || DGifSlurp(gif.get()) != GIF_OK) return film;
    const auto width = static_cast<std::size_t>(gif->SWidth);
    std::string canvas;
    for (int k = 0; k < gif->SWidth * gif->SHeight; ++k) canvas += hole;
    for (int k = 0; k < gif->ImageCount; ++k) {
        const SavedImage& image = gif->SavedImages[k];
        for (int e = 0; k == 0 && e < image.ExtensionBlockCount; ++e) {
            const ExtensionBlock& block = image.ExtensionBlocks[e];
            film.repeats = film.repeats ||
                           (block.Function == APPLICATION_EXT_FUNC_CODE && block.ByteCount == 11);
        }
        GraphicsControlBlock control;
        if (DGifSavedExtensionToGCB(gif.get(), k, &control) != GIF_OK) return film;
        const GifImageDesc& part = image.ImageDesc;
        const ColorMapObject* map = part.ColorMap ? part.ColorMap : gif->SColorMap;
        std::string next = canvas;
        for (int y = 0; y < part.Height; ++y) {
            for (int x = 0; x < part.Width; ++x) {
                const int number = image.RasterBits[y * part.Width + x];
                if (number == control.TransparentColor) continue;
                const std::size_t place = static_cast<std::size_t>(part.Top + y) * width +
                                          static_cast<std::size_t>(part.Left + x);
                next.replace(4 * place, 4, colour_of(map->Colors[number]));
            }
        }
        film.frames.push_back(next);
        film.times.push_back(control.DelayTime);
        film.parts.push_back({part.Left, part.Top, part.Width, part.Height});
        if (control.DisposalMode != DISPOSE_BACKGROUND) canvas = next;
    }
    return film;
}

class Gif : public FilmTest {};

TEST_F(Gif, HoldsEveryPixelOfFewColours) {
    const std::vector<FilmFrame> frames = moving_disc();
    FilmSettings settings;
    settings.frames_per_second = 40;
    write("disc.gif", frames, settings);
    const ShownGif film = shown_gif(path("disc.gif"));
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(film.frames[k], frames[k].pixels) << k;
    }
    EXPECT_THAT(film.times, testing::ElementsAre(3, 2, 3, 2, 3));
    EXPECT_TRUE(film.repeats);
    EXPECT_EQ(film.parts[0], (FramePart{0, 0, 23, 17}));
    EXPECT_LT(film.parts[1].width * film.parts[1].height, 23 * 17 / 2);
}

TEST_F(Gif, GivesAFrameItsOwnFewColours) {
    // The film chooses its colours from samples without the second frame.
    const std::vector<FilmFrame> frames = {many_colours(0),
                                           film_frame(Image(96, 96, {1, 0, 0.3F}))};
    auto film = begin_film(path("own.gif"), {}, {frames.data(), 1});
    ASSERT_TRUE(film);
    for (const FilmFrame& frame : frames) ASSERT_TRUE((*film)->add(frame));
    ASSERT_TRUE((*film)->finish());
    const ShownGif read = shown_gif(path("own.gif"));
    ASSERT_EQ(read.frames.size(), 2U);
    EXPECT_EQ(read.frames[1], frames[1].pixels);
}

TEST_F(Gif, KeepsColoursStillWhereNothingChanges) {
    const std::vector<FilmFrame> frames = {many_colours(0), many_colours(0.5F), many_colours(1)};
    write("many.gif", frames);
    const ShownGif film = shown_gif(path("many.gif"));
    ASSERT_EQ(film.frames.size(), 3U);
    const std::size_t still = std::size_t{4} * 96 * 48;
    int furthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(film.frames[k].substr(still), film.frames[0].substr(still)) << k;
        for (std::size_t b = 0; b < film.frames[k].size(); ++b) {
            const auto level = [](char byte) { return static_cast<unsigned char>(byte); };
            furthest =
                std::max(furthest, std::abs(level(film.frames[k][b]) - level(frames[k].pixels[b])));
        }
    }
    // 256 colours divide the cube into boxes of 255 / 6.3 ≈ 40 levels, whose corners are further
    // away.
    EXPECT_LT(furthest, 60);
}

TEST_F(Gif, HoldsHolesThatComeAndGo) {
    const FilmFrame disc = disc_frame(20, 12, 9, 5);
    const std::vector<FilmFrame> frames = {with_hole(disc, 2), with_hole(disc, 8), disc};
    write("holes.gif", frames);
    const ShownGif film = shown_gif(path("holes.gif"));
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(film.frames[k], frames[k].pixels) << k;
    }
}

TEST_F(Gif, GivesAFrameWithHolesItsOwnFewColours) {
    const std::vector<FilmFrame> frames = {with_hole(many_colours(0), 5),
                                           with_hole(disc_frame(96, 96, 40, 40), 9)};
    auto film = begin_film(path("own.gif"), {}, {frames.data(), 1});
    ASSERT_TRUE(film);
    for (const FilmFrame& frame : frames) ASSERT_TRUE((*film)->add(frame));
    ASSERT_TRUE((*film)->finish());
    const ShownGif read = shown_gif(path("own.gif"));
    ASSERT_EQ(read.frames.size(), 2U);
    EXPECT_EQ(read.frames[1], frames[1].pixels);
}

TEST_F(Gif, MayBeNothingButAHole) {
    const std::vector<FilmFrame> frames = {film_frame(Image(3, 2, transparent))};
    write("hole.gif", frames);
    const ShownGif film = shown_gif(path("hole.gif"));
    ASSERT_EQ(film.frames.size(), 1U);
    EXPECT_EQ(film.frames[0], frames[0].pixels);
}

}  // namespace
}  // namespace cascade
