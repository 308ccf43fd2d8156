// For tests of films: a folder, and frames to write.
#pragma once

#include "core/file.h"
#include "film/film.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

class FilmTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "cascade-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::string bytes(const std::string& name) const {
        return read_file(path(name), 1 << 26).value_or("");
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                      std::filesystem::directory_iterator()));
    }

    void write(const std::string& name, const std::vector<FilmFrame>& frames,
               const FilmSettings& settings = {}) const {
        auto film = begin_film(path(name), settings, frames);
        ASSERT_TRUE(film) << film.error().message;
        for (const FilmFrame& frame : frames) {
            const auto added = (*film)->add(frame);
            ASSERT_TRUE(added) << added.error().message;
        }
        const auto done = (*film)->finish();
        ASSERT_TRUE(done) << done.error().message;
    }

    std::filesystem::path folder_;
};

/// A disc of few colours that moves over a uniform background, so that only a part of each frame
/// changes.
inline FilmFrame disc_frame(std::int64_t width, std::int64_t height, double x, double y) {
    Image image(width, height, {0.2F, 0.4F, 0.6F});
    for (std::int64_t j = 0; j < height; ++j) {
        for (std::int64_t i = 0; i < width; ++i) {
            const double distance =
                std::hypot(static_cast<double>(i) - x, static_cast<double>(j) - y);
            if (distance < 4) image.at(i, j) = {static_cast<float>(distance) / 4, 0.5F, 0};
        }
    }
    return film_frame(image);
}

inline std::vector<FilmFrame> moving_disc(int count = 5) {
    std::vector<FilmFrame> frames;
    for (int k = 0; k < count; ++k) frames.push_back(disc_frame(23, 17, 5 + 2.5 * k, 6 + k));
    return frames;
}

/// A gradient over all levels of red and green, with far more than 256 colours, and a background
/// that does not change.
inline FilmFrame many_colours(float blue) {
    Image image(96, 96);
    for (std::int64_t y = 0; y < 96; ++y) {
        for (std::int64_t x = 0; x < 96; ++x) {
            image.at(x, y) = {static_cast<float>(x) / 95, static_cast<float>(y) / 95,
                              y < 48 ? blue : 0.5F};
        }
    }
    return film_frame(image);
}

/// The disc on a transparent background.
inline FilmFrame with_hole(FilmFrame frame, std::int64_t hole_end) {
    for (std::int64_t x = 0; x < hole_end; ++x) {
        for (std::size_t c = 0; c < 4; ++c) {
            frame.pixels[static_cast<std::size_t>(x) * 4 + c] = static_cast<char>(c == 3 ? 0 : 255);
        }
    }
    return frame;
}

}  // namespace cascade
