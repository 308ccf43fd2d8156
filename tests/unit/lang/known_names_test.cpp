// The names that can be typed next, and the meaning of a name, depend on the position in the text.
#include "check_helpers.h"
#include "lang/service/known_names.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

class KnownNames : public ::testing::Test {
protected:
    KnownNames()
        : program_(
              *check_text("system s { u: 1; k: 2 in 0 .. 9 ## how fast\n d = k * u\n u' = d }\n"
                          "system w { u: 1; m: 3 ## another\n u' = m }\n"
                          "stage one: s { }\nstage two: w { u: one.u }\n")
                   ->program) {}
    std::vector<std::string> after(std::string_view text) const {
        std::vector<std::string> names;
        for (KnownName& known : completions(text, text.size(), program_))
            names.push_back(std::move(known.name));
        return names;
    }
    std::optional<Mention> at_end(std::string_view text, std::uint32_t stage) const {
        return mention(text, text.size(), program_, stage);
    }
    Program program_;
};

TEST_F(KnownNames, EveryNameIsOfferedWhereNoBlockIsOpen) {
    const std::vector<std::string> names = after("sta");
    for (const char* name : {"one", "s", "u", "d", "iterations", "tanh", "stage", "turing_spots"}) {
        EXPECT_THAT(names, Contains(name));
    }
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST_F(KnownNames, StatementsBeginWithWhatTheirBlockHas) {
    EXPECT_THAT(after("domain { grid: 4, 5; bou"), Contains("boundary"));
    EXPECT_THAT(after("domain { grid: 4, 5; bou"), Not(Contains("iterations")));
    EXPECT_THAT(after("stage one: s {\n  iter"), IsSupersetOf({"iterations", "u", "k"}));
    EXPECT_THAT(after("stage one: s {\n  iter"), Not(Contains("disc")));
    EXPECT_THAT(after("picture { co"), IsSupersetOf({"color", "shape"}));
}

TEST_F(KnownNames, CommentsDoNotGoOn) {
    EXPECT_THAT(after("stage one: s {\n u: 1 +\n"), Not(Contains("iterations")));
    EXPECT_THAT(after("stage one: s {\n u: 1  # of a and b:\n"), Contains("iterations"));
    EXPECT_THAT(after("stage one: s {\n u: 1 +  # and\n"), Not(Contains("iterations")));
}

TEST_F(KnownNames, ValuesAreOfWhatTheyMayBe) {
    EXPECT_THAT(after("system s { u' = k * la"), IsSupersetOf({"lap", "u", "k", "d", "pi"}));
    EXPECT_THAT(after("system s { u' = k *\n  la"), Contains("lap"));
    EXPECT_THAT(after("system s { u' = k * la"), Not(Contains("iterations")));
    EXPECT_THAT(after("domain { boundary: no"), ElementsAre("noflux", "periodic"));
    EXPECT_THAT(after("stage one: s { solver: "), Contains("rk4"));
    EXPECT_THAT(after("stage one: s { speed: "), IsSupersetOf({"auto", "u"}));
}

TEST_F(KnownNames, SystemsItemsAndPalettesHaveTheirPlaces) {
    EXPECT_THAT(after("stage three: "), IsSupersetOf({"s", "w", "turing_spots"}));
    EXPECT_THAT(after("stage three: "), Not(Contains("lap")));
    EXPECT_THAT(after("stage two: w { u: one."), ElementsAre("u", "k", "frozen", "speed"));
    EXPECT_THAT(after("picture { color: palette(u, 0, 1, \"leo"), Contains("leopard"));
    EXPECT_THAT(after("field(\"leo"), IsEmpty());
    EXPECT_THAT(after("system s { # la"), IsEmpty());
    EXPECT_THAT(after("system s { # comment\n  u' = la"), Contains("lap"));
}

TEST_F(KnownNames, NamesMeanWhatTheyDoInTheirStage) {
    const auto k = at_end("system s { u: 1; k", 1);
    ASSERT_TRUE(k && k->item);
    EXPECT_EQ(k->known.kind, NameKind::parameter);
    EXPECT_EQ(k->known.note, "how fast");
    EXPECT_EQ(k->item->stage, 0U);
    const auto at = [&](std::string_view text, std::uint32_t stage) {
        return at_end(text, stage)->item->stage;
    };
    EXPECT_EQ(at("u", 1), 1U);
    EXPECT_EQ(at("u", 0), 0U);
    EXPECT_EQ(at("stage two: w { u: one.u", 1), 0U);
    EXPECT_EQ(at("stage two: w { u", 0), 1U);
    EXPECT_EQ(at_end("u' = lap", 0)->known.kind, NameKind::function);
    EXPECT_EQ(at_end("stage one: s { speed", 0)->known.kind, NameKind::setting);
    EXPECT_FALSE(at_end("# u", 0));
    EXPECT_FALSE(at_end("nobody", 0));
    EXPECT_FALSE(at_end("", 0));
}

TEST_F(KnownNames, OnlyTheTextBeforeAPositionCounts) {
    const std::string_view text = "stage one: s { speed: 1 }\n# u";
    EXPECT_EQ(mention(text, text.find("eed"), program_, 0)->known.name, "speed");
    EXPECT_EQ(mention(text, text.find("speed"), program_, 0)->known.name, "speed");
    EXPECT_EQ(mention(text, text.find("s {"), program_, 0)->known.kind, NameKind::system);
    std::vector<std::string> names;
    for (KnownName& known : completions(text, text.find("eed"), program_))
        names.push_back(std::move(known.name));
    EXPECT_THAT(names, IsSupersetOf({"solver", "speed"}));
}

}  // namespace
}  // namespace cascade::test
