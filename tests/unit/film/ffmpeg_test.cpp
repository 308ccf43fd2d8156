// Films by ffmpeg, if it is installed, and messages if it is missing or fails.
#include "film/frames_in_film.h"
#include "film_fixture.h"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace cascade {
namespace {

using testing::HasSubstr;

/// Sets the folders in which programs are searched, while the object exists.
class SearchedFolders {
public:
    explicit SearchedFolders(const std::string& folders) : before_(std::getenv("PATH")) {
        ::setenv("PATH", folders.c_str(), 1);
    }
    ~SearchedFolders() { ::setenv("PATH", before_.c_str(), 1); }

private:
    std::string before_;
};

class Ffmpeg : public FilmTest {
protected:
    void SetUp() override {
        FilmTest::SetUp();
        std::signal(SIGPIPE, SIG_IGN);
    }

    /// Makes a program `ffmpeg` in the folder bin.
    void make_program(const std::string& text) const {
        std::filesystem::create_directories(path("bin"));
        ASSERT_TRUE(write_file(path("bin/ffmpeg"), "#!/bin/sh\n" + text));
        std::filesystem::permissions(path("bin/ffmpeg"), std::filesystem::perms::owner_all);
    }

    /// All pixels of a film, decoded by ffmpeg. `decoder` holds the options that choose a decoder.
    /// If it is empty, ffmpeg chooses one.
    std::string decoded(const std::string& name, const std::string& format = "rgb24",
                        const std::string& decoder = "") const {
        const std::string command = "ffmpeg -v error " + decoder + " -i '" + path(name).string() +
                                    "' -f rawvideo -pix_fmt " + format + " -";
        std::FILE* const pipe = ::popen(command.c_str(), "r");
        std::string pixels;
        for (int byte = std::fgetc(pipe); byte != EOF; byte = std::fgetc(pipe)) {
            pixels += static_cast<char>(byte);
        }
        ::pclose(pipe);
        return pixels;
    }
};

TEST_F(Ffmpeg, WritesWhatItsDecoderShows) {
    if (!check_film(path("a.mp4"))) GTEST_SKIP() << "ffmpeg is not installed";
    // Odd sides get one more row and column.
    std::vector<FilmFrame> frames;
    for (int k = 0; k < 4; ++k) {
        const float share = static_cast<float>(k) / 4;
        frames.push_back(film_frame(Image(33, 21, {share, 0.75F, 1 - share})));
    }
    for (const std::string name : {"a.mp4", "a.webm"}) {
        write(name, frames);
        const std::string pixels = decoded(name);
        ASSERT_EQ(pixels.size(), 4U * 34 * 22 * 3) << name;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto level = [](char byte) { return static_cast<unsigned char>(byte); };
                EXPECT_NEAR(level(pixels[(k * 34 * 22 + 340) * 3 + c]), level(frames[k].pixels[c]),
                            4)
                    << name << ", frame " << k << ", channel " << c;
            }
        }
    }
    EXPECT_EQ(files(), 2U);
    EXPECT_TRUE(check_film_size(path("b.mp4"), 33, 21));
    EXPECT_EQ(files(), 2U);
}

TEST_F(Ffmpeg, KeepsOpacityInWebmAndLaysMp4OnWhite) {
    if (!check_film(path("a.mp4"))) GTEST_SKIP() << "ffmpeg is not installed";
    Image image(64, 32, {1, 0, 0});
    for (std::int64_t y = 0; y < 32; ++y) {
        for (std::int64_t x = 0; x < 64; ++x) {
            image.alpha.push_back(x < 16 ? 1 : x < 48 ? 0.4F : 0);
        }
    }
    const std::vector<FilmFrame> frames(3, film_frame(image));
    for (const std::string name : {"a.webm", "a.mp4"}) write(name, frames);
    // A level of the pixel at x in the last row.
    const auto level = [](const std::string& pixels, std::size_t x, std::size_t channel) {
        return static_cast<unsigned char>(pixels[(31 * 64 + x) * 4 + channel]);
    };
    // ffmpeg's own decoder of VP9 leaves alpha out.
    const std::string webm = decoded("a.webm", "rgba", "-c:v libvpx-vp9");
    ASSERT_EQ(webm.size(), 3U * 64 * 32 * 4);
    EXPECT_NEAR(level(webm, 8, 3), 255, 4);
    EXPECT_NEAR(level(webm, 32, 3), 102, 4);
    EXPECT_NEAR(level(webm, 56, 3), 0, 4);
    EXPECT_NEAR(level(webm, 32, 0), 255, 4) << "not multiplied by alpha";
    EXPECT_NEAR(level(webm, 32, 1), 0, 8);
    const std::string mp4 = decoded("a.mp4", "rgba");
    EXPECT_NEAR(level(mp4, 8, 1), 0, 6);
    EXPECT_NEAR(level(mp4, 32, 1), 153, 6);
    EXPECT_NEAR(level(mp4, 56, 1), 255, 6);
}

TEST_F(Ffmpeg, IsAskedForWhereItIsMissing) {
    const SearchedFolders nowhere("::relative:" + path("bin").string());
    const auto checked = check_film(path("a.mp4"));
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().message, HasSubstr("needs the program ffmpeg"));
    EXPECT_THAT(checked.error().hint, HasSubstr("apt-get install ffmpeg"));
    EXPECT_TRUE(check_film(path("a.gif")));
    EXPECT_FALSE(begin_film(path("a.webm"), {}, moving_disc()));
    EXPECT_EQ(files(), 0U);
}

TEST_F(Ffmpeg, HasTheLastWordWhereItFails) {
    make_program("echo first >&2; echo \"Unknown encoder 'libx264'\" >&2; exit 1\n");
    const SearchedFolders folders(path("bin").string() + ":/bin:/usr/bin");
    const auto tried = check_film_size(path("a.mp4"), 640, 480);
    ASSERT_FALSE(tried);
    EXPECT_THAT(tried.error().message, HasSubstr("a.mp4': Unknown encoder 'libx264'"));
    // Many frames, so that the pipe breaks while they are written.
    const std::vector<FilmFrame> frames(200, many_colours(0));
    auto film = begin_film(path("a.mp4"), {}, frames);
    ASSERT_TRUE(film);
    std::optional<Failure> failed;
    for (std::size_t k = 0; !failed && k < frames.size(); ++k) {
        if (auto added = (*film)->add(frames[k]); !added) failed = added.error();
    }
    ASSERT_TRUE(failed);
    EXPECT_THAT(failed->message, HasSubstr("Unknown encoder"));
    film->reset();
    EXPECT_EQ(files(), 1U) << "nothing but bin";
}

/// The result of writing a film of 40 frames of 60 kB.
Result<void> filmed(const std::filesystem::path& path, const std::atomic<bool>& cancel) {
    const std::vector<FilmFrame> frames(40, film_frame(Image(160, 128)));
    FilmSettings settings;
    settings.cancel = &cancel;
    auto film = begin_film(path, settings, frames);
    if (!film) return tl::unexpected(film.error());
    for (const FilmFrame& frame : frames) {
        if (auto added = (*film)->add(frame); !added) return added;
    }
    return (*film)->finish();
}

TEST_F(Ffmpeg, IsNotBelievedWhereItLies) {
    const std::string last = "for file; do :; done; file=${file#file:}; ";
    const auto said = [&](const std::string& program) {
        make_program(last + program);
        const SearchedFolders folders(path("bin").string() + ":/bin:/usr/bin");
        const auto done = filmed(path("a.mp4"), never_cancelled);
        EXPECT_EQ(files(), 1U) << program;
        return done ? "done" : done.error().message;
    };
    const std::string too_early = "it ended before all frames were written";
    EXPECT_THAT(said("exit 0\n"), HasSubstr(too_early));
    EXPECT_THAT(said("head -c 100000 >/dev/null; exit 0\n"), HasSubstr(too_early));
    EXPECT_THAT(said("head -c 2457599 >/dev/null; exit 0\n"), HasSubstr(too_early)) << "a byte";
    const std::string no_film = "it did not write a complete film";
    EXPECT_THAT(said("cat >/dev/null; exit 0\n"), HasSubstr(no_film));
    EXPECT_THAT(said("cat >/dev/null; echo GIF89a >\"$file\"; exit 0\n"), HasSubstr(no_film));
    EXPECT_THAT(said("cat >/dev/null; rm \"$file\"; exit 0\n"), HasSubstr(no_film));
    make_program("sleep 0.2; cat >/dev/null\n");
    const SearchedFolders folders(path("bin").string() + ":/bin:/usr/bin");
    EXPECT_TRUE(check_film_size(path("a.mp4"), 640, 480)) << "slow, but right";
    make_program("exit 0\n");
    EXPECT_FALSE(check_film_size(path("a.mp4"), 64, 48));
}

TEST_F(Ffmpeg, DoesNotOutliveTheEndOfTheProgram) {
    std::atomic<bool> cancel = true;
    for (const std::string program :
         {"exec sleep 300\n", "sleep 300\n", "cat >/dev/null; sleep 300\n"}) {
        make_program(program);
        const SearchedFolders folders(path("bin").string() + ":/bin:/usr/bin");
        const auto tried = check_film_size(path("a.mp4"), 640, 480, cancel);
        ASSERT_FALSE(tried);
        EXPECT_THAT(tried.error().message, HasSubstr("it made no progress and was stopped"));
    }
    const SearchedFolders folders(path("bin").string() + ":/bin:/usr/bin");
    const auto done = filmed(path("a.mp4"), cancel);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("it made no progress and was stopped"));
    EXPECT_EQ(files(), 1U);
}

TEST_F(Ffmpeg, WritesAWholeFilmAlthoughTheProgramIsToEnd) {
    if (!check_film(path("a.mp4"))) GTEST_SKIP() << "ffmpeg is not installed";
    const std::atomic<bool> cancel = true;
    for (const char* name : {"a.mp4", "a.webm"}) {
        const auto done = filmed(path(name), cancel);
        EXPECT_TRUE(done) << done.error().message;
        EXPECT_EQ(frames_in_film(path(name), name == std::string("a.webm")), 40) << name;
        const std::string whole = bytes(name);
        for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{3}}) {
            ASSERT_TRUE(write_file(path("cut"), whole.substr(0, size)));
            EXPECT_FALSE(frames_in_film(path("cut"), name == std::string("a.webm")))
                << name << ", " << size;
        }
    }
}

TEST_F(Ffmpeg, GetsNamesThatNoShellReads) {
    if (!check_film(path("a.mp4"))) GTEST_SKIP() << "ffmpeg is not installed";
    const std::string name = "-i $(touch x); 'a' http:b.mp4";
    write(name, moving_disc(2));
    EXPECT_GT(bytes(name).size(), 100U);
    EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace cascade
