// Animated PNG files, decoded by the test.
#include "film_fixture.h"

#include "tests/unit/picture/png_chunks.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using test::number_at;

struct Animation {
    std::vector<std::string> frames;  ///< Pixels in RGBA.
    std::vector<unsigned> times;      ///< In ms.
    std::uint32_t stated = 0;         ///< Number of frames that the file states.
};

/// Decodes a file as the specification says, and checks the order of chunks.
Animation decoded(const std::string& file) {
    Animation film;
    std::uint32_t width = 0, height = 0, next = 0;
    std::string canvas, data;
    test::Chunk control;
    const auto show = [&] {
        if (control.data.empty()) return;
        const std::uint32_t w = number_at(control.data, 4), h = number_at(control.data, 8);
        const std::uint32_t x = number_at(control.data, 12), y = number_at(control.data, 16);
        ASSERT_TRUE(x + w <= width && y + h <= height);
        const std::string rows = test::unfiltered(test::inflated(data, (w * 4 + 1) * h), w * 4, 4);
        ASSERT_EQ(rows.size(), w * h * 4);
        for (std::uint32_t j = 0; j < h; ++j) {
            canvas.replace(((y + j) * width + x) * 4, w * 4, rows, j * w * 4, w * 4);
        }
        film.frames.push_back(canvas);
        data.clear();
    };
    for (const test::Chunk& chunk : test::take_apart(file)) {
        if (chunk.name == "IHDR") {
            width = number_at(chunk.data, 0);
            height = number_at(chunk.data, 4);
            canvas.assign(width * height * 4, '\0');
            EXPECT_EQ(chunk.data.substr(8), std::string("\x08\x06\0\0\0", 5));
        } else if (chunk.name == "acTL") {
            film.stated = number_at(chunk.data, 0);
            EXPECT_EQ(number_at(chunk.data, 4), 0U) << "it repeats for ever";
        } else if (chunk.name == "fcTL") {
            show();
            control = chunk;
            EXPECT_EQ(number_at(chunk.data, 0), next++);
            const std::uint32_t delay = number_at(chunk.data, 20);
            EXPECT_EQ(delay & 0xffff, 1000U);
            film.times.push_back(delay >> 16);
        } else if (chunk.name == "IDAT") {
            EXPECT_TRUE(film.frames.empty());
            data += chunk.data;
        } else if (chunk.name == "fdAT") {
            EXPECT_EQ(number_at(chunk.data, 0), next++);
            data += chunk.data.substr(4);
        }
    }
    show();
    return film;
}

class Apng : public FilmTest {};

TEST_F(Apng, HoldsEveryPixelOfEveryFrame) {
    const std::vector<FilmFrame> frames = moving_disc();
    FilmSettings settings;
    settings.frames_per_second = 30;
    write("disc.apng", frames, settings);
    const Animation film = decoded(bytes("disc.apng"));
    EXPECT_EQ(film.stated, frames.size());
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(film.frames[k], frames[k].pixels) << k;
    }
    EXPECT_THAT(film.times, testing::ElementsAre(33, 34, 33, 33, 34));
    EXPECT_EQ(files(), 1U);
}

TEST_F(Apng, HoldsHolesThatComeAndGo) {
    const FilmFrame disc = disc_frame(20, 12, 9, 5);
    const std::vector<FilmFrame> frames = {disc, with_hole(disc, 8), with_hole(disc, 3), disc,
                                           disc};
    write("holes.apng", frames);
    const Animation film = decoded(bytes("holes.apng"));
    ASSERT_EQ(film.frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
        EXPECT_EQ(film.frames[k], frames[k].pixels) << k;
    }
}

TEST_F(Apng, CarriesItsTexts) {
    FilmSettings settings;
    settings.texts = {{"Cascade script", "stage s: turing_spots { }"}};
    write("disc.apng", moving_disc(2), settings);
    const auto texts = read_png_texts(path("disc.apng"));
    ASSERT_TRUE(texts);
    EXPECT_EQ(*texts, settings.texts);
}

TEST_F(Apng, IsNotThereBeforeItIsComplete) {
    ASSERT_TRUE(write_file(path("disc.apng"), "an older film"));
    {
        const std::vector<FilmFrame> frames = moving_disc();
        auto film = begin_film(path("disc.apng"), {}, frames);
        ASSERT_TRUE(film);
        ASSERT_TRUE((*film)->add(frames[0]));
        EXPECT_EQ(bytes("disc.apng"), "an older film");
        EXPECT_EQ(files(), 2U);
    }
    EXPECT_EQ(bytes("disc.apng"), "an older film");
    EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace cascade
