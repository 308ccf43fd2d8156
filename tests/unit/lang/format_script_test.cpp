// The canonical style by examples. Formatting keeps the meaning, and formatting again changes
// nothing.
#include "lang/format/format_script.h"
#include "lang/syntax/parse.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

std::optional<std::string> formatted(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    return format_script(sources.add("test.cascade", text), sources, diagnostics);
}

/// Formats a text. If formatting again would change the result, returns both results.
std::string once(const std::string& text) {
    const auto first = formatted(text);
    if (!first) return "cannot be read";
    const auto second = formatted(*first);
    return second == first ? *first : *first + "\n--- changed again:\n" + second.value_or("");
}

std::string in_system(const std::string& statement) {
    return "system s {\n  " + statement + "\n}\n";
}
std::string statement(const std::string& text) {
    const std::string result = once(in_system(text));
    const std::string before = "system s {\n  ", after = "\n}\n";
    if (!result.starts_with(before) || !result.ends_with(after)) return result;
    return result.substr(before.size(), result.size() - before.size() - after.size());
}

TEST(FormatScript, PutsOneBlankAroundOperatorsAndNoneInsideBrackets) {
    EXPECT_EQ(statement("a:1"), "a: 1");
    EXPECT_EQ(statement("a  :  1"), "a: 1");
    EXPECT_EQ(statement("a'=b+c-d"), "a' = b + c - d");
    EXPECT_EQ(statement("a '  +=lap( b )"), "a' += lap(b)");
    EXPECT_EQ(statement("a>=0"), "a >= 0");
    EXPECT_EQ(statement("a: if( b<4 and not c,min (b ,c),[ d ])"),
              "a: if(b < 4 and not c, min(b, c), [d])");
    EXPECT_EQ(statement("a: large . b ^ 2"), "a: large.b^2");
    EXPECT_EQ(statement("a: (b)^( c+1 )"), "a: (b)^(c + 1)");
    EXPECT_EQ(statement("a: grad( u ).x+J . y*(v+w).z"), "a: grad(u).x + J.y*(v + w).z");
}

TEST(FormatScript, GluesASignToItsOperand) {
    EXPECT_EQ(statement("a: - b - - c"), "a: -b - -c");
    EXPECT_EQ(statement("a: - - b"), "a: - -b");
    EXPECT_EQ(statement("a: 2 ^ - 1 * - 3"), "a: 2^-1 * -3");
    EXPECT_EQ(statement("a: f(- 1, - x)"), "a: f(-1, -x)");
    EXPECT_EQ(statement("a: not - b < - c"), "a: not -b < -c");
}

TEST(FormatScript, LeavesTheAuthorTheChoiceAroundProducts) {
    EXPECT_EQ(statement("a: b*c+1/8"), "a: b*c + 1/8");
    EXPECT_EQ(statement("a: b * c + 1 / 8"), "a: b * c + 1 / 8");
    EXPECT_EQ(statement("a: b *c + 1/ 8"), "a: b * c + 1 / 8");
    EXPECT_EQ(statement("a: 0.05 * 1/16"), "a: 0.05 * 1/16");
}

TEST(FormatScript, IndentsBlocksByTwoAndKeepsOneBlankLine) {
    EXPECT_EQ(once("\n\nsystem s\n{\n\n\n\ta: 1\n\n\n        b: 2\n\n}\n\n\n\ndomain{grid:8,8}"),
              "system s {\n  a: 1\n\n  b: 2\n}\n\ndomain { grid: 8, 8 }\n");
    EXPECT_EQ(once("system_name:s\n  a:1\n\n\n  system_name:  s ; a: 2"),
              "system_name: s\na: 1\n\nsystem_name: s; a: 2\n");
    EXPECT_EQ(once("domain {}\ndomain{ }\ndomain {\n}"), "domain { }\ndomain { }\ndomain {\n}\n");
    EXPECT_EQ(once("system s { a: 1 } stage t:s{a:2}"), "system s { a: 1 }\nstage t: s { a: 2 }\n");
}

TEST(FormatScript, ReadsEveryLineEndAndTheByteOrderMark) {
    EXPECT_EQ(once("\xef\xbb\xbfsystem s {\r\na: 1\r\n\r\nb: 2\r}\r\n"),
              "system s {\n  a: 1\n\n  b: 2\n}\n");
}

TEST(FormatScript, KeepsStatementsTogetherThatStandOnALine) {
    EXPECT_EQ(once("system s{a:1;b:2;}"), "system s { a: 1; b: 2 }\n");
    EXPECT_EQ(once("system s {\na:1;b:2;\n;;c:3;\n}"), "system s {\n  a: 1; b: 2\n  c: 3\n}\n");
    EXPECT_EQ(once("system s { a: 1\n}"), "system s {\n  a: 1\n}\n");
    EXPECT_EQ(once("system s { a: 1 # one\n}"), "system s {\n  a: 1  # one\n}\n");
}

TEST(FormatScript, SplitsWhatDoesNotFitALine) {
    const std::string name(30, 'n');
    const std::string one = name + ": 1";
    const std::string row = one + "; " + one + "; " + one;
    EXPECT_EQ(once("stage t: s { " + row + " }"),
              "stage t: s {\n  " + one + "\n  " + one + "\n  " + one + "\n}\n");
    const std::string two = one + "; " + one;
    EXPECT_EQ(once("stage t: s { " + two + " }"), "stage t: s { " + two + " }\n");
    EXPECT_EQ(statement(row), one + "\n  " + one + "\n  " + one);
    EXPECT_EQ(statement(two), two);
}

TEST(FormatScript, KeepsCommentsWhereTheyAre) {
    EXPECT_EQ(
        once("# top  \n\n\n# second\nsystem s { # behind\n    # own\na: 1# short\n\n# last\n}"),
        "# top\n\n# second\nsystem s {  # behind\n  # own\n  a: 1  # short\n\n  # last\n}\n");
    EXPECT_EQ(once("system s # name\n{\na: 1\n} # end\n#after"),
              "system s  # name\n{\n  a: 1\n}  # end\n#after\n");
    EXPECT_EQ(statement("a: min(1, # one\n# between\n2)"),
              "a: min(1,  # one\n         # between\n         2)");
}

TEST(FormatScript, LeavesCommentsInTheirColumn) {
    const std::string kept = "a: 1        # one\n  bc: 23     # two";
    EXPECT_EQ(statement("a: 1        # one\n  bc: 23      # two"),
              "a: 1        # one\n  bc: 23      # two");
    // A longer line moves the column of comments. A single comment keeps its distance.
    EXPECT_EQ(statement("a: random(1,2,3,4)  # one\n  b: 1                # two"),
              "a: random(1, 2, 3, 4)  # one\n  b: 1                   # two");
    EXPECT_EQ(statement("a: 1      # one"), "a: 1      # one");
    EXPECT_EQ(statement(kept), kept);
}

TEST(FormatScript, KeepsEquationsLinedUp) {
    const std::string equations =
        "a' = ka * (16 - a*b)       + diff_a * lap(a)\n"
        "  b' = ka * (a*b - b - beta) + diff_b * lap(b)";
    EXPECT_EQ(statement(equations), equations);
    EXPECT_EQ(statement("a' = ka*(16 -a*b)        + lap(a)\n  b' = ka*(a*b - b - beta) + lap(b)"),
              "a' = ka*(16 - a*b)       + lap(a)\n  b' = ka*(a*b - b - beta) + lap(b)");
    EXPECT_EQ(statement("cells' = 1\n  bait'  = 2"), "cells' = 1\n  bait'  = 2");
    // Signs that are not aligned with a neighbour lose extra blanks.
    EXPECT_EQ(statement("a' = 1   + b\n  c' = 1 + d"), "a' = 1 + b\n  c' = 1 + d");
    EXPECT_EQ(statement("a:    1\n  b:    2"), "a: 1\n  b: 2");
}

TEST(FormatScript, KeepsLineEndsInsideStatements) {
    EXPECT_EQ(statement("a: if(b < 4,\n c,\n d)"), "a: if(b < 4,\n        c,\n        d)");
    EXPECT_EQ(statement("a: f(\n1,\n2\n)"), "a: f(\n    1,\n    2\n  )");
    EXPECT_EQ(statement("a: 1/200 +\n1/1000"), "a: 1/200 +\n     1/1000");
    EXPECT_EQ(statement("a' =\n\n\nb"), "a' =\n      b");
    EXPECT_EQ(statement("a: g(b,\nmin(1,\n2))"), "a: g(b,\n       min(1,\n           2))");
}

TEST(FormatScript, KnowsFamiliesRangesAndFunctions) {
    EXPECT_EQ(statement("i: 1..n"), "i: 1..n");
    EXPECT_EQ(statement("i: 1 ..n"), "i: 1 .. n");
    EXPECT_EQ(statement("a: 1 in 0  .. (2)step 0.1"), "a: 1 in 0 .. (2) step 0.1");
    EXPECT_EQ(statement("a: 1 in - 2 .. - 1"), "a: 1 in -2 .. -1");
    EXPECT_EQ(statement("u[ i ]'=sum( u[i+1] over i )"), "u[i]' = sum(u[i + 1] over i)");
    EXPECT_EQ(statement("a: [ u[ i ] ]+[b]"), "a: [u[i]] + [b]");
    EXPECT_EQ(statement("a: step (x, 1)*step(y,2)"), "a: step(x, 1)*step(y, 2)");
    EXPECT_EQ(once("use\"a.cascade\";fn f (r,w)=exp( -r )\nsystem s:t{a:1}"),
              "use \"a.cascade\"; fn f(r, w) = exp(-r)\nsystem s: t { a: 1 }\n");
    EXPECT_EQ(once("## of s\nsystem s { a: 1 ## of a\n}"),
              "## of s\nsystem s {\n  a: 1  ## of a\n}\n");
}

TEST(FormatScript, TouchesNoScriptThatCannotBeRead) {
    for (const char* wrong : {"", "system s {", "system s { a: }", "system s { a: (1 }",
                              "system s { a: 1 § }", "# only a comment"}) {
        EXPECT_EQ(formatted(wrong), std::nullopt) << wrong;
    }
}

/// A text of separators alone would be formatted to an empty script, which is refused.
TEST(FormatScript, RefusesWhatIsMadeOfSeparators) {
    for (const char* text : {";", ";;", "\n;", ";# a comment", " ; \n ; "}) {
        EXPECT_FALSE(formatted(text)) << text;
    }
}

TEST(FormatScript, TakesLargeScriptsInItsStride) {
    std::string deep =
        "system s { a: " + std::string(100000, '(') + "1" + std::string(100000, ')') + " }";
    EXPECT_EQ(formatted(deep), "system s {\n  " + deep.substr(11, deep.size() - 13) + "\n}\n");
    std::string nested = "system s { a: 1";
    for (int k = 0; k < 20000; ++k) nested += " + (\n2 - g(3,\n4";
    const auto in_view = formatted(nested + std::string(40000, ')') + " }");
    ASSERT_TRUE(in_view);
    EXPECT_LT(in_view->size(), 4000000u);
    EXPECT_EQ(formatted(*in_view), in_view);
    std::string long_row = "system s { a: 1";
    for (int k = 0; k < 100000; ++k) long_row += "; b: 2 + 3";
    EXPECT_TRUE(formatted(long_row + " }"));
    std::string lines = "system s {\n";
    for (int k = 0; k < 50000; ++k) lines += "a'   = 1   + b   # c\n";
    const auto result = formatted(lines + "}");
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->starts_with("system s {\n  a'   = 1   + b   # c\n  a'"));
}

}  // namespace
}  // namespace cascade
