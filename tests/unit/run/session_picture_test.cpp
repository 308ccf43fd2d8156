// Pictures that carry a session, including pictures that were changed to do harm.
#include "run/session/session_picture.h"

#include "run/commands/run.h"
#include "run/script/embedded_script.h"
#include "tests/support/limited_memory.h"
#include "tests/unit/run/run_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using ::testing::HasSubstr;

class SessionPictureTest : public RunTest {
protected:
    /// A picture that carries a small script, and this text as its session.
    std::string picture_with(const std::string& session) {
        const Script script = load_script("small", small, ".");
        PngTexts texts = embed_script(script, {});
        texts[key_session] = session;
        const std::string file = path("picture.png");
        EXPECT_TRUE(write_png(file, Image(2, 2), PngDepth::eight, texts));
        return file;
    }
    /// The message that says why a picture with this session cannot be run.
    std::string refused(const std::string& session) {
        auto file = load_script_file(picture_with(session));
        EXPECT_TRUE(file);
        const auto log = session_of(*file);
        if (!log) return log.error().message;
        RunRequest wanted = request();
        wanted.outputs = {path("again.png")};
        wanted.session = *log;
        RunControl control;
        const auto report = run(file->script, wanted, control);
        return report ? "" : report.error().message;
    }
    std::string session(const std::string& changes) const {
        return std::string("cascade session 1\nname small\noptions {}\nscript 3\n") + small + "\n" +
               changes;
    }

    static constexpr const char* small =
        "domain { grid: 8, 8 }\nstage s: turing_spots { iterations: 20 }\n";
};

TEST_F(SessionPictureTest, ASessionIsPlayed) {
    EXPECT_EQ(refused(session("at 1 5\npaint b=b + 1\nend 1 10\n")), "");
    EXPECT_FALSE(bytes("again.png").empty());
}

TEST_F(SessionPictureTest, WhatIsNoSessionIsRefused) {
    EXPECT_THAT(refused("anything"), HasSubstr("line 1 of the session"));
    EXPECT_THAT(refused(session("at 1 5\n")), HasSubstr("the session has no end"));
}

TEST_F(SessionPictureTest, AChangeThatFailsIsTold) {
    EXPECT_THAT(refused(session("at 1 5\npaint b=nobody\nend 1 10\n")), HasSubstr("nobody"));
    EXPECT_THAT(refused(session("end 1 30\n")), HasSubstr("which this run does not reach"));
}

TEST_F(SessionPictureTest, AnotherScriptThanThatOfThePictureIsRefused) {
    EXPECT_THAT(refused(session("at 1 5\nset s.ka=1/50\nend 1 10\n")),
                HasSubstr("does not end with the script of the picture"));
    EXPECT_THAT(refused(session("at 1 5\ntext 1\nstage s: turing_spots { }\nend 1 10\n")),
                HasSubstr("does not end with the script of the picture"));
}

TEST_F(SessionPictureTest, MillionsOfChangesAreRefused) {
    std::string changes;
    for (std::size_t k = 0; k <= most_logged_changes; ++k) changes += "next\n";
    const std::string log = session(changes + "end 1 10\n");
    EXPECT_EQ(test::in_limited_memory(std::uint64_t{128} << 20,
                                      [&] {
                                          const auto parsed = parse_session_log(log);
                                          return parsed ? "a session" : parsed.error().hint;
                                      }),
              "sessions are written by ':save NAME.session', not by hand");
}

}  // namespace
}  // namespace cascade
