// The library of systems: only named systems are read, and a script may replace them.
#include "lang/library/library.h"

#include "check_helpers.h"

#include <fmt/format.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> system_names(const std::string& script) {
    const auto checked = check_text(script);
    EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    std::vector<std::string> names;
    if (!checked->program) return names;
    for (const System& system : checked->program->systems) names.push_back(system.name);
    return names;
}

TEST(Library, IsInOrderAndFoundByName) {
    const auto texts = library_texts();
    ASSERT_GE(texts.size(), 3u);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_LT(i == 0 ? "" : texts[i - 1].system_name(), texts[i].system_name());
        EXPECT_EQ(find_library_text(texts[i].system_name()), &texts[i]);
    }
    EXPECT_EQ(find_library_text("no_such_system"), nullptr);
    EXPECT_EQ(find_library_text(""), nullptr);
}

TEST(Library, ShapesAreInOrderAndFoundByName) {
    const auto texts = library_shapes();
    ASSERT_GE(texts.size(), 5u);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_LT(i == 0 ? "" : texts[i - 1].system_name(), texts[i].system_name());
        EXPECT_EQ(find_shape_text(texts[i].system_name()), &texts[i]);
    }
    EXPECT_EQ(find_shape_text("scales"), nullptr);
    EXPECT_EQ(find_library_text("thorn"), nullptr);
}

/// Each text is also a complete script for `cascade run`.
TEST(Library, TextsAreSoundScripts) {
    for (const LibraryText& each : library_texts()) {
        const auto checked = check_text(std::string(each.text));
        EXPECT_TRUE(checked->program) << each.file_name;
        EXPECT_THAT(checked->faults(), IsEmpty()) << each.file_name;
    }
}

TEST(Library, SaysWhichSystemsDoNotFitADomain) {
    const auto checked =
        check_text("domain { grid: 6, 5, 4 }\nsystem mine: vortices {}\nstage one: mine {}");
    EXPECT_FALSE(checked->program);
    EXPECT_THAT(checked->faults(),
                Contains(HasSubstr("2:14: 'vortices' does not work in this domain")));
    EXPECT_THAT(checked->faults(), Contains(HasSubstr("in three dimensions, curl takes a vector")));
}

TEST(Library, IsReadByNeed) {
    EXPECT_THAT(system_names("system_name: stripes\n"), ElementsAre("stripes"));
    EXPECT_THAT(system_names("stage a: stripes {}\nstage b: turing_spots {}\nstage c: stripes {}"),
                ElementsAre("stripes", "turing_spots"));
    EXPECT_THAT(system_names("system mine { a: 1; a' = a }"), ElementsAre("mine"));
    EXPECT_THAT(system_names("domain { grid: 8, 8 }"), IsEmpty());
}

/// A script without a stage gets one message and reads nothing of the library.
TEST(Library, CostsNothingWhereNothingIsNamed) {
    const auto checked = check_text("a: 4");
    EXPECT_FALSE(checked->faults().empty());
    EXPECT_EQ(checked->sources.size(), 1u);
}

TEST(Library, GivesWayToTheScriptsOwn) {
    EXPECT_THAT(system_names("system stripes { q: 1; q' = q }\nstage s: stripes { q: 2 }"),
                ElementsAre("stripes"));
}

TEST(Library, IsSearchedForNearNames) {
    EXPECT_THAT(check_text("system_name: turing_spot")->faults(),
                ElementsAre("1:14: there is no system 'turing_spot' | "
                            "did you mean 'turing_spots'?"));
}

}  // namespace
}  // namespace cascade::test
