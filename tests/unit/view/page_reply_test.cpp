// Replies to what pages ask: the log, names to type next, and what a name means now.
#include "view/page_reply.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace cascade {
namespace {

using Json = nlohmann::json;

constexpr std::string_view waves = R"(domain { grid: 6, 4; mask: x < 0.5 }
system waves {
  u: 1 + x
  k: 0.5 in 0 .. 1   ## how fast it fades
  u' = -k * u
}
stage one: waves { iterations: 5 }
)";

class PageReply : public testing::Test {
protected:
    void SetUp() override {
        SimulationOptions options;
        options.backend = BackendKind::interpreter;
        options.threads = 1;
        RunControl control;
        auto run =
            LiveRun::begin(load_script("waves.cascade", std::string(waves), "."), options, control);
        ASSERT_TRUE(run.has_value());
        run_ = std::move(*run);
    }
    Json reply(const PageQuestion& question) const {
        return Json::parse(print_reply(3, question, *run_));
    }
    std::unique_ptr<LiveRun> run_;
};

TEST_F(PageReply, Log) {
    const Json log = reply(AskForLog{});
    EXPECT_EQ(log["kind"], "log");
    EXPECT_EQ(log["id"], 3);
    EXPECT_TRUE(is_session_log(log["text"].get<std::string>()));
}

TEST_F(PageReply, NamesToTypeNext) {
    const Json reply = this->reply(AskForNames{"stage two: waves { u: one."});
    EXPECT_EQ(reply["kind"], "names");
    EXPECT_EQ(reply["names"][1],
              Json({{"name", "k"}, {"what", "parameter"}, {"note", "how fast it fades"}}));
}

TEST_F(PageReply, MeaningOfANameNow) {
    const Json k = reply(AskAboutName{"u' = -k"});
    EXPECT_EQ(k["kind"], "explanation");
    EXPECT_EQ(k["what"], "parameter");
    EXPECT_EQ(k["note"], "how fast it fades");
    EXPECT_EQ(k["value"], 0.5);
    EXPECT_EQ(k["range"], Json({0, 1}));
    const Json u = reply(AskAboutName{"u"});
    EXPECT_EQ(u["what"], "species");
    EXPECT_FALSE(u.contains("value"));
    EXPECT_GT(u["smallest"], 1) << "cells outside of the mask do not count";
    EXPECT_LT(u["largest"], 1.5);
    EXPECT_THAT(u["equation"].get<std::string>(), testing::HasSubstr("<mi>k</mi>"));
    EXPECT_FALSE(reply(AskAboutName{"nobody"}).contains("name"));
}

}  // namespace
}  // namespace cascade
