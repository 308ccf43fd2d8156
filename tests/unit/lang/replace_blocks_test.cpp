// Blocks that are added to a script replace blocks of the same name.
#include "lang/syntax/replace_blocks.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

constexpr const char* script =
    "domain { grid: 8, 8 }\n"
    "fn f(x) = x\n"
    "# The first.\n"
    "stage one: s {\n"
    "  k: 1\n"
    "}\n"
    "stage two: s { }\n";

TEST(ReplaceBlocks, ABlockOfTheSameNameStandsWhereTheOldOneStood) {
    EXPECT_EQ(with_blocks(script, "stage one: t { k: 2 }\n"),
              "domain { grid: 8, 8 }\nfn f(x) = x\n# The first.\nstage one: t { k: 2 }\n"
              "stage two: s { }\n");
    EXPECT_EQ(with_blocks(script, "domain { grid: 9, 9 }").substr(0, 22),
              "domain { grid: 9, 9 }\n");
    EXPECT_EQ(with_blocks(script, "fn f(y) = 2*y\n").substr(22, 14), "fn f(y) = 2*y\n");
}

TEST(ReplaceBlocks, WhatIsNewComesAtTheEnd) {
    EXPECT_EQ(with_blocks(script, "stage three: s { }\n"),
              script + std::string("stage three: s { }\n"));
    EXPECT_EQ(with_blocks(script, "stage two: t { }\n# Last.\nstage three: s { }\n"),
              "domain { grid: 8, 8 }\nfn f(x) = x\n# The first.\nstage one: s {\n  k: 1\n}\n"
              "stage two: t { }\n# Last.\nstage three: s { }\n");
    // A system may have the same name as a stage.
    EXPECT_EQ(with_blocks(script, "system one { }\n"), script + std::string("system one { }\n"));
}

TEST(ReplaceBlocks, WhatIsWrongOrNoBlockIsAppended) {
    for (const char* added : {"stage one: s {\n", "system_name: turing_spots\n", "stage one {}\n",
                              "stage one: s { k: }\n", "use \"other.cascade\"\n"}) {
        EXPECT_EQ(with_blocks(script, added), script + std::string(added));
    }
    EXPECT_EQ(with_blocks("", "stage one: s { }\n"), "stage one: s { }\n");
}

TEST(ReplaceBlocks, ScriptsMayDifferInPicturesOnly) {
    const std::string same = script;
    EXPECT_TRUE(differ_in_pictures_only(same, same));
    EXPECT_TRUE(
        differ_in_pictures_only(same, "# Other words.\n\npicture { color: rgb(1, 0, 0) }\n" + same +
                                          "\nshape s { radius = 1 - t }\n"));
    EXPECT_TRUE(differ_in_pictures_only(same + "picture { shape: thorn }",
                                        "picture { shape: ball }\n" + same));
    EXPECT_FALSE(differ_in_pictures_only(same, same + "stage three: s { }\n"));
    EXPECT_FALSE(differ_in_pictures_only("stage a: s { k: 1; m: 2 }", "stage a: s { k: 1 }"));
    EXPECT_FALSE(differ_in_pictures_only("stage a: s { k: 11 }", "stage a: s { k: 1 1 }"));
    EXPECT_FALSE(differ_in_pictures_only(same, same + "picture { color"));
}

}  // namespace
}  // namespace cascade
