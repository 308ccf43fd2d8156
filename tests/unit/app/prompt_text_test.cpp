// When a typed line is complete, and how a word can continue.
#include "app/prompt_text.h"

#include "app/line_reader.h"

#include <gmock/gmock.h>

#include <unistd.h>

namespace cascade {
namespace {

using testing::ElementsAre;

TEST(PromptText, a_line_is_complete_when_all_brackets_are_closed) {
    EXPECT_TRUE(is_complete("ka: 1/80\n"));
    EXPECT_FALSE(is_complete("stage s: turing_spots {\n"));
    EXPECT_FALSE(is_complete("stage s: turing_spots {\n  ka: max(1,\n"));
    EXPECT_TRUE(is_complete("stage s: turing_spots {\n  ka: 1\n}\n"));
    EXPECT_TRUE(is_complete("ka: 1)\n"));
}

TEST(PromptText, an_operator_or_a_comma_asks_for_more) {
    for (const char* line : {"a: 1 +", "a: 1 *  ", "a: b and", "a: not # why", "grid: 4,"}) {
        EXPECT_FALSE(is_complete(line)) << line;
    }
    for (const char* line : {"a: band", "a: 1", "a: color"}) EXPECT_TRUE(is_complete(line)) << line;
}

TEST(PromptText, words_are_those_of_a_shell) {
    EXPECT_THAT(words_of("--log 'mean(v over domain)'  -q"),
                ElementsAre("--log", "mean(v over domain)", "-q"));
    EXPECT_THAT(words_of("a\"b 'c\"d '' e"), ElementsAre("ab 'cd", "", "e"));
    EXPECT_THAT(words_of("  "), ElementsAre());
}

TEST(PromptText, brackets_in_comments_and_quotes_do_not_count) {
    EXPECT_TRUE(is_complete("a: 1 # {\n"));
    EXPECT_TRUE(is_complete("a: field(\"x{#.npy\")\n"));
    EXPECT_FALSE(is_complete("s { # }\n"));
}

TEST(PromptText, says_nothing) {
    EXPECT_TRUE(says_nothing(""));
    EXPECT_TRUE(says_nothing("  # a remark"));
    EXPECT_FALSE(says_nothing("a: 1"));
}

TEST(PromptText, completion_adds_what_choices_share) {
    const std::vector<std::string> names = {"diff_a", "diff_b", "beta", "diff_a"};
    const Completion shared = complete_word("  ka: di", names);
    EXPECT_EQ(shared.insert, "ff_");
    EXPECT_THAT(shared.choices, ElementsAre("diff_a", "diff_b"));
    EXPECT_EQ(complete_word("be", names).insert, "ta ");
    EXPECT_EQ(complete_word("x", names).insert, "");
    EXPECT_THAT(complete_word("x", names).choices, ElementsAre());
    EXPECT_EQ(complete_word(":sh", {":show", ":run"}).insert, "ow ");
    EXPECT_EQ(complete_word("stage s:be", names).insert, "ta ");
}

TEST(PlainReader, lines_of_a_pipe) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const std::string text = "one\n\ntwo\r\n" + std::string(10000, 'x') + "\nlast";
    ASSERT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    close(ends[1]);
    const auto reader = make_plain_reader(ends[0]);
    EXPECT_EQ(reader->read("").text, "one");
    EXPECT_EQ(reader->read("").text, "");
    EXPECT_EQ(reader->read("").text, "two");
    EXPECT_EQ(reader->read("").text.size(), 10000U);
    EXPECT_EQ(reader->read("").text, "last");
    EXPECT_EQ(reader->read("").kind, TypedLine::Kind::end);
    close(ends[0]);
}

}  // namespace
}  // namespace cascade
