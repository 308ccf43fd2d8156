// Animated WebP files, read by libwebpdemux.
#include "film_fixture.h"

#include <gmock/gmock.h>
#include <webp/demux.h>

#include <memory>

namespace cascade {
namespace {

struct ShownWebp {
    std::vector<std::string> frames;  ///< Pixels in RGBA.
    std::vector<int> ends;            ///< When the frames end, in ms.
    std::uint32_t repeats = 99;       ///< 0 means for ever.
};

ShownWebp shown_webp(const std::string& file) {
    ShownWebp film;
    WebPAnimDecoderOptions options;
    if (WebPAnimDecoderOptionsInit(&options) == 0) return film;
    const WebPData data{reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
    const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
        WebPAnimDecoderNew(&data, &options), WebPAnimDecoderDelete);
    if (!decoder) return film;
    WebPAnimInfo info;
    if (WebPAnimDecoderGetInfo(decoder.get(), &info) == 0) return film;
    film.repeats = info.loop_count;
    std::uint8_t* pixels = nullptr;
    int end = 0;
    while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0 &&
           WebPAnimDecoderGetNext(decoder.get(), &pixels, &end) != 0) {
        film.frames.emplace_back(reinterpret_cast<const char*>(pixels),
                                 std::size_t{4} * info.canvas_width * info.canvas_height);
        film.ends.push_back(end);
    }
    return film;
}

/// Sets transparent pixels to one colour, since their colours do not matter.
std::string seen(std::string pixels) {
    for (std::size_t k = 0; k < pixels.size(); k += 4) {
        if (pixels[k + 3] == 0) pixels.replace(k, 4, 4, '\0');
    }
    return pixels;
}

class Webp : public FilmTest {};

TEST_F(Webp, HoldsEveryPixelOfEveryFrame) {
    const std::vector<FilmFrame> frames = moving_disc();
    FilmSettings settings;
    settings.frames_per_second = 12;
    write("disc.webp", frames, settings);
    const ShownWebp film = shown_webp(bytes("disc.webp"));
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(film.frames[k], frames[k].pixels) << k;
    }
    EXPECT_THAT(film.ends, testing::ElementsAre(83, 167, 250, 333, 417));
    EXPECT_EQ(film.repeats, 0U);
    EXPECT_EQ(files(), 1U);
}

TEST_F(Webp, HoldsHolesThatComeAndGo) {
    const FilmFrame disc = disc_frame(21, 13, 9, 5);
    const std::vector<FilmFrame> frames = {disc, with_hole(disc, 8), with_hole(disc, 3), disc};
    write("holes.webp", frames);
    const ShownWebp film = shown_webp(bytes("holes.webp"));
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(seen(film.frames[k]), seen(frames[k].pixels)) << k;
    }
}

TEST_F(Webp, HoldsManyColours) {
    const std::vector<FilmFrame> frames = {many_colours(0), many_colours(0.7F)};
    write("many.webp", frames);
    const ShownWebp film = shown_webp(bytes("many.webp"));
    ASSERT_EQ(film.frames.size(), 2U);
    EXPECT_EQ(film.frames[1], frames[1].pixels);
}

}  // namespace
}  // namespace cascade
