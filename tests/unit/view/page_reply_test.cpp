// Replies to requests of pages: the log, completions, and the present meaning of a name.
#include "view/page_reply.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace cascade {
namespace {

using Json = nlohmann::json;

constexpr std::string_view fading_waves = R"(domain { grid: 6, 4; mask: x < 0.5 }
system waves {
  u: 1 + x
  k: 0.5 in 0 .. 1   ## how fast it fades
  u' = -k * u
}
stage one: waves { iterations: 5 }
)";

class PageReply : public testing::Test {
protected:
    void SetUp() override { begin(fading_waves); }
    void begin(std::string_view text) {
        SimulationOptions options;
        options.backend = "interp";
        options.threads = 1;
        RunControl control;
        auto run =
            LiveRun::begin(load_script("waves.cascade", std::string(text), "."), options, control);
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

TEST_F(PageReply, ValuesOfACellAndOfAll) {
    const Json reply = this->reply(AskForValues{7});
    EXPECT_EQ(reply["kind"], "values");
    EXPECT_EQ(reply["t"], 0);
    const Json& u = reply["species"][0];
    EXPECT_EQ(u["name"], "u");
    EXPECT_FLOAT_EQ(u["value"].get<float>(), 1.25F) << "the second cell of the second row";
    EXPECT_FLOAT_EQ(u["mean"].get<float>(), 1.25F);
    EXPECT_LT(u["smallest"], 1.1);
    EXPECT_TRUE(this->reply(AskForValues{4})["species"][0]["value"].is_null()) << "outside";
    for (const std::int64_t cell : {-1, 24}) {
        EXPECT_FALSE(this->reply(AskForValues{cell})["species"][0].contains("value"));
    }
    RunControl control;
    ASSERT_TRUE(run_->advance(2, control));
    EXPECT_EQ(this->reply(AskForValues{})["t"], 2);
}

TEST_F(PageReply, Measures) {
    const Json reply = this->reply(AskForMeasures{"u", "u"});
    EXPECT_EQ(reply["kind"], "measures");
    int cells = 0, pairs = 0;
    for (const int count : reply["histogram"]) cells += count;
    for (const int count : reply["density"]) pairs += count;
    EXPECT_EQ(cells, 12) << "half of the grid is outside";
    EXPECT_EQ(pairs, 12);
    EXPECT_EQ(reply["histogram"][0], 4);
    EXPECT_GT(reply["seconds"], 0);
    EXPECT_EQ(reply["density"][0], 4);
    EXPECT_EQ(reply["density"].back(), 4);
    EXPECT_FLOAT_EQ(reply["x"][0].get<float>(), 1 + 0.5F / 6);
    EXPECT_FALSE(this->reply(AskForMeasures{"u", "k"}).contains("histogram"));
}

TEST_F(PageReply, FeaturesOfWhatIsShown) {
    const Json reply = this->reply(AskForFeatures{""});
    EXPECT_EQ(reply["kind"], "features");
    EXPECT_FLOAT_EQ(reply["features"]["mean"].get<float>(), 1.25F);
    EXPECT_FLOAT_EQ(reply["features"]["smallest"].get<float>(), 1 + 0.5F / 6);
    EXPECT_FLOAT_EQ(this->reply(AskForFeatures{"2 * u"})["features"]["mean"].get<float>(), 2.5F);
    EXPECT_EQ(this->reply(AskForFeatures{"2 * nobody"})["is_done"], false);
}

TEST_F(PageReply, FixesMendWhatTheirHintsTell) {
    const auto fixes = [&](const std::string& text) { return reply(AskForFixes{text})["fixes"]; };
    const auto script = [](const std::string& rate) {
        return "system s { u: 1; k: 2\n u' = " + rate + " }\nstage a: s { }\n";
    };
    EXPECT_EQ(fixes(script("k * lapp(u)")), Json({"lap"}));
    EXPECT_EQ(fixes(script("k ** u")), Json({"^"}));
    EXPECT_EQ(fixes(script("kk + vv + lapp(u)")), Json({"k * k", nullptr, "lap"}));
    EXPECT_EQ(fixes(script("k (u - 1)")), Json({nullptr})) << "it leaves something open";
    EXPECT_EQ(fixes(script("u")), Json::array());
    EXPECT_EQ(fixes(script("kk") + std::string(65536, '#')), Json::array()) << "too long";
}

TEST_F(PageReply, UsesAndDeclarationOfAName) {
    const std::string text =
        "# \u00b5\nsystem s { k: 2\n \u03b1: k; \u03b1' = k }\nstage a: s { k: 3 }\n";
    const Json k = reply(AskForUses{text, text.find("k }")});
    EXPECT_EQ(k["kind"], "uses");
    EXPECT_EQ(k["name"], "k");
    EXPECT_EQ(k["declaration"], Json({{"from", {2, 11}}, {"to", {2, 12}}}));
    ASSERT_EQ(k["uses"].size(), 4U);
    EXPECT_EQ(k["uses"][1], Json({{"from", {3, 4}}, {"to", {3, 5}}}));
    EXPECT_EQ(reply(AskForUses{text, 0})["uses"], Json::array());
    EXPECT_EQ(reply(AskForUses{text, 0})["declaration"], nullptr);
    EXPECT_EQ(reply(AskForUses{text, text.size() + 99})["uses"], Json::array());
    const std::string library = "stage a: gray_scott { feed: 0.03 }\n";
    EXPECT_TRUE(reply(AskForUses{library, library.find("feed")})["declaration"].contains("source"));
}

TEST_F(PageReply, RenamesANameOrSaysWhyNot) {
    const std::string text = "system s { k: 2; u: k; u' = k }\nstage a: s { k: 3 }\n";
    const auto renamed = [&](const std::string& name) {
        return reply(AskToRename{text, text.find('k'), name});
    };
    EXPECT_EQ(renamed("rate")["text"],
              "system s { rate: 2; u: rate; u' = rate }\nstage a: s { rate: 3 }\n");
    const Json refused = renamed("u");
    EXPECT_EQ(refused["is_done"], false);
    EXPECT_EQ(refused["id"], 3);
    EXPECT_NE(refused["messages"][0]["message"].get<std::string>().find("'u'"), std::string::npos);
}

TEST_F(PageReply, Picture) {
    PictureRequest request;
    request.palette = "leopard";
    const Json reply = this->reply(AskForPicture{request});
    EXPECT_EQ(reply["kind"], "picture");
    EXPECT_EQ(reply["id"], 3);
    EXPECT_THAT(reply["png"].get<std::string>(), testing::StartsWith("iVBORw0KGgo"));
    request.show = "nobody";
    const Json refused = this->reply(AskForPicture{request});
    EXPECT_EQ(refused["kind"], "answer");
    EXPECT_EQ(refused["id"], 3);
    EXPECT_EQ(refused["is_done"], false);
    EXPECT_THAT(refused["messages"][0]["message"].get<std::string>(), testing::HasSubstr("nobody"));
    request.show = "";
    request.palette = "no palette";
    EXPECT_EQ(this->reply(AskForPicture{request})["is_done"], false);
}

TEST_F(PageReply, PicturesThatAreTooLargeAreRefused) {
    RunControl control;
    ASSERT_TRUE(run_->apply(SetText{"domain { grid: 300, 300 }\nsystem s { u: 1; u' = 0 }\n"
                                    "stage one: s { }\n"},
                            control));
    PictureRequest request;
    request.scale = 64;
    const Json refused = reply(AskForPicture{request});
    EXPECT_EQ(refused["is_done"], false);
    EXPECT_THAT(refused["messages"][0]["message"].get<std::string>(), testing::HasSubstr("pixels"));
}

TEST_F(PageReply, SpectrumWithItsWavelength) {
    const std::string script =
        "domain { grid: 32, 32 }\n"
        "system s { u: sin(8 * pi * x); u' = 0 }\nstage one: s { }\n";
    RunControl control;
    ASSERT_TRUE(run_->apply(SetText{script}, control));
    const Json reply = this->reply(AskForMeasures{"u", "u"});
    EXPECT_NEAR(reply["wavelength"].get<double>(), 8, 1e-6);
    EXPECT_NEAR(reply["ring_width"].get<double>(), 1.0 / 32, 1e-12);
    EXPECT_NEAR(reply["spectrum"][4].get<double>(), 0.5, 1e-6);
}

/// There are more cells than a row of memory holds, and places after the last cell must not count
/// as cells.
TEST_F(PageReply, CellsThatCrawl) {
    begin(
        "cells dot { c: 2 + x; c' = 0; d: 1; d' = 0 }\ndomain { grid: 8, 8 }\n"
        "stage one: dot { founders: 700; iterations: 5 }\n");
    const Json values = reply(AskForValues{699});
    std::vector<std::string> names;
    for (const Json& species : values["species"]) names.push_back(species["name"]);
    EXPECT_THAT(names, testing::UnorderedElementsAre("r", "age", "c", "d"));
    for (const Json& species : values["species"]) {
        if (species["name"] != "c") continue;
        EXPECT_GE(species["smallest"], 2);
        EXPECT_GE(species["value"], 2);
    }
    EXPECT_FALSE(reply(AskForValues{700})["species"][0].contains("value"));
    const Json measures = reply(AskForMeasures{"c", "d"});
    int count = 0;
    for (const Json& bin : measures["histogram"]) count += bin.get<int>();
    EXPECT_EQ(count, 700);
    EXPECT_FALSE(measures.contains("spectrum"));
}

}  // namespace
}  // namespace cascade
