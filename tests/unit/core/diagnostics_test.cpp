// Diagnostics: collecting and rendering messages.
#include "core/diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The rendered message about the bytes [begin, end) of a text.
std::string draw(std::string text, std::uint32_t begin, std::uint32_t end, std::string hint = "") {
    Sources sources;
    const SourceId source = sources.add("leopard.cascade", std::move(text));
    Diagnostic diagnostic;
    diagnostic.span = {source, begin, end};
    diagnostic.message = "wrong";
    diagnostic.hint = std::move(hint);
    return render(diagnostic, sources, {});
}

TEST(Diagnostics, DrawsTheMessageOfTheSpecification) {
    Sources sources;
    std::string text(16, '\n');
    text += "      beta: betta\n";
    const SourceId source = sources.add("leopard.cascade", text);
    Diagnostic diagnostic;
    diagnostic.span = {source, 28, 33};
    diagnostic.message = "'betta' is not a parameter of turing_spots";
    diagnostic.hint = "did you mean 'beta'?";
    diagnostic.notes.push_back({std::nullopt, "bare names read the previous stage 'large'"});
    EXPECT_EQ(render(diagnostic, sources, {}),
              "leopard.cascade:17:13: error: 'betta' is not a parameter of turing_spots\n"
              "   17 |       beta: betta\n"
              "      |             ^~~~~ did you mean 'beta'?\n"
              "note: bare names read the previous stage 'large'\n");
}

TEST(Diagnostics, DrawsTheLineOfANoteWithAPlace) {
    Sources sources;
    const SourceId source = sources.add("s", "a: 1\na: 2\n");
    Diagnostic diagnostic{Severity::warning, {source, 5, 6}, "'a' is given twice", "", {}};
    diagnostic.notes.push_back({Span{source, 0, 1}, "the first is here"});
    EXPECT_EQ(render(diagnostic, sources, {}),
              "s:2:1: warning: 'a' is given twice\n"
              "    2 | a: 2\n"
              "      | ^\n"
              "s:1:1: note: the first is here\n"
              "    1 | a: 1\n"
              "      | ^\n");
}

TEST(Diagnostics, TabsAndWideLettersKeepTheMarkerInPlace) {
    EXPECT_EQ(draw("\ta\tb", 3, 4),
              "leopard.cascade:1:4: error: wrong\n"
              "    1 |         a       b\n"
              "      |                 ^\n");
    EXPECT_EQ(draw("\xe6\xbc\xa2"
                   "ab",
                   3, 5),  // This letter is two columns wide.
              "leopard.cascade:1:2: error: wrong\n"
              "    1 | \xe6\xbc\xa2"
              "ab\n"
              "      |   ^~\n");
}

TEST(Diagnostics, NothingStrangeReachesTheTerminal) {
    const std::string drawn = draw("a\x1b[31m\x07\xff\xe2\x80\xae", 0, 1);
    EXPECT_THAT(drawn,
                HasSubstr("    1 | a\xef\xbf\xbd[31m\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\n"));
    EXPECT_THAT(drawn, Not(HasSubstr("\x1b")));
    // This character changes the writing direction.
    EXPECT_THAT(drawn, Not(HasSubstr("\xe2\x80\xae")));
}

TEST(Diagnostics, LongLinesAreCutAroundTheSpan) {
    const std::string text = std::string(5000, 'x') + "here" + std::string(5000, 'y');
    const std::string drawn = draw(text, 5000, 5004, "look");
    EXPECT_EQ(drawn,
              "leopard.cascade:1:5001: error: wrong\n"
              "    1 | \xe2\x80\xa6" +
                  std::string(40, 'x') + "here" + std::string(55, 'y') +
                  "\xe2\x80\xa6\n"
                  "      | " +
                  std::string(41, ' ') + "^~~~ look\n");
}

TEST(Diagnostics, ASpanOverSeveralLinesIsUnderlinedOnTheFirst) {
    EXPECT_EQ(draw("ab (\ncd)", 3, 8),
              "leopard.cascade:1:4: error: wrong\n"
              "    1 | ab (\n"
              "      |    ^\n");
}

TEST(Diagnostics, APlaceBehindTheLastCharacterHasAMarker) {
    EXPECT_EQ(draw("ab", 2, 2),
              "leopard.cascade:1:3: error: wrong\n"
              "    1 | ab\n"
              "      |   ^\n");
    EXPECT_EQ(draw("", 0, 0),
              "leopard.cascade:1:1: error: wrong\n"
              "    1 | \n"
              "      | ^\n");
}

TEST(Diagnostics, ColoursOnlyWhereAskedFor) {
    Sources sources;
    const SourceId source = sources.add("s", "a");
    const Diagnostic diagnostic{Severity::error, {source, 0, 1}, "wrong", "", {}};
    EXPECT_THAT(render(diagnostic, sources, {.colour = true}),
                HasSubstr("\x1b[1;31merror:\x1b[0m"));
    EXPECT_THAT(render(diagnostic, sources, {}), Not(HasSubstr("\x1b")));
}

TEST(Diagnostics, TheSameFaultIsKeptOnce) {
    Diagnostics diagnostics;
    diagnostics.error({0, 1, 2}, "wrong");
    diagnostics.error({0, 1, 2}, "wrong", "another hint");
    diagnostics.error({0, 1, 3}, "wrong");
    diagnostics.error({0, 1, 2}, "also wrong");
    EXPECT_EQ(diagnostics.error_count(), 3u);
    EXPECT_EQ(diagnostics.sorted().size(), 3u);
}

TEST(Diagnostics, WarningsAreNoErrors) {
    Diagnostics diagnostics;
    EXPECT_TRUE(diagnostics.empty());
    diagnostics.warning({0, 1, 2}, "odd");
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_FALSE(diagnostics.empty());
    diagnostics.error({0, 1, 2}, "wrong");
    EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Diagnostics, AreSortedAndTheRestIsCounted) {
    Sources sources;
    const SourceId source = sources.add("s", "abcdef");
    Diagnostics diagnostics;
    diagnostics.error({source, 3, 4}, "third");
    diagnostics.error({source, 1, 2}, "second");
    diagnostics.warning({source, 0, 1}, "first");
    diagnostics.warning({source, 4, 5}, "fourth");
    diagnostics.error({source, 5, 6}, "fifth");
    const std::string drawn = render(diagnostics, sources, {.most = 2});
    EXPECT_THAT(drawn, testing::StartsWith("s:1:1: warning: first\n"));
    EXPECT_THAT(drawn, HasSubstr("s:1:2: error: second\n"));
    EXPECT_THAT(drawn, Not(HasSubstr("third")));
    EXPECT_THAT(drawn, testing::EndsWith("2 more errors and 1 more warning not shown\n"));
}

TEST(Diagnostics, ATextThatIsNoScriptCannotFillTheMemory) {
    Diagnostics diagnostics;
    for (std::uint32_t k = 0; k < 3 * Diagnostics::most_kept; ++k) {
        diagnostics.error({0, k, k + 1}, "wrong");
    }
    EXPECT_EQ(diagnostics.error_count(), 3 * Diagnostics::most_kept);
    EXPECT_EQ(diagnostics.sorted().size(), Diagnostics::most_kept);
}

}  // namespace
}  // namespace cascade
