// The parser: precedence, and the ends of statements and blocks.
#include "lang/syntax/parse.h"
#include "parsed_text.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace cascade {
namespace {

using test::expression_of;
using test::parse_text;
using test::tree_of;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Expressions, BindAsTheSpecificationSays) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"1 + 2*3", "(+ 1 (* 2 3))"},
        {"1*2 + 3", "(+ (* 1 2) 3)"},
        {"1 - 2 - 3", "(- (- 1 2) 3)"},
        {"0.05 * 1/16", "(/ (* 0.05 1) 16)"},
        {"(1 + 2)*3", "(* (+ 1 2) 3)"},
        {"-x^2", "(- (^ x 2))"},
        {"2^-1", "(^ 2 (- 1))"},
        {"2^-1^2", "(^ 2 (- (^ 1 2)))"},
        {"2^-1*3", "(* (^ 2 (- 1)) 3)"},
        {"2^3^4", "(^ 2 (^ 3 4))"},
        {"-a*b", "(* (- a) b)"},
        {"a - -b", "(- a (- b))"},
        {"--a", "(- (- a))"},
        {"a < b + 1", "(< a (+ b 1))"},
        {"not a < b", "(not (< a b))"},
        {"not not a", "(not (not a))"},
        {"not a and b", "(and (not a) b)"},
        {"a or b and c", "(or a (and b c))"},
        {"a and b or c", "(or (and a b) c)"},
        {"a < b and c >= d", "(and (< a b) (>= c d))"},
        {"(a < b) < c", "(< (< a b) c)"},
        {"a != b or not a == c", "(or (!= a b) (not (== a c)))"},
        {"a <= b", "(<= a b)"},
        {"a > b", "(> a b)"},
    };
    for (const auto& [text, tree] : cases) EXPECT_EQ(expression_of(text), tree) << text;
}

TEST(Expressions, HaveManyKindsOfOperands) {
    EXPECT_EQ(expression_of("[p] + p + large.p + p'"), "(+ (+ (+ [p] p) large.p) p')");
    EXPECT_EQ(expression_of("J.x * grad(u).y - (v + w).z^2 + J[2].x"),
              "(+ (- (* (.x J) (.y (grad u))) (^ (.z (+ v w)) 2)) (.x (member J 2)))");
    EXPECT_EQ(expression_of("[ p ]"), "[p]");
    EXPECT_EQ(expression_of("if([frozen], 4, a)"), "(if [frozen] 4 a)");
    EXPECT_EQ(expression_of("f()"), "(f)");
    EXPECT_EQ(expression_of("f(g(1, 2), h(3), (4))"), "(f (g 1 2) (h 3) 4)");
    EXPECT_EQ(expression_of("palette(b, 0, 8, \"tan\")"), "(palette b 0 8 \"tan\")");
    EXPECT_EQ(expression_of(".25 + 1e-3 + 4."), "(+ (+ 0.25 0.001) 4)");
    EXPECT_EQ(expression_of("3.4028235e38"), "3.4028235e+38");
    EXPECT_EQ(expression_of("0e-999"), "0");
}

TEST(Expressions, GoOnBehindOperatorsAndInsideBrackets) {
    EXPECT_EQ(expression_of("1 +\n 2"), "(+ 1 2)");
    EXPECT_EQ(expression_of("not\n a"), "(not a)");
    EXPECT_EQ(expression_of("(1\n + 2\n)"), "(+ 1 2)");
    EXPECT_EQ(expression_of("f(1,\n # remark\n\n 2\n)"), "(f 1 2)");
    EXPECT_EQ(expression_of("[\np\n]"), "[p]");
    EXPECT_EQ(expression_of("f\t(1)"), "(f 1)");
}

TEST(Expressions, PartsComeBeforeTheWhole) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("test", "system_name: s\na: f(1, (b - 2) * 3)\nb: 4");
    const ast::Script script = parse(source, sources, diagnostics);
    const auto& statements = script.blocks.at(0).statements;
    ASSERT_EQ(statements.size(), 2u);
    EXPECT_EQ(statements[0].values[0].first, 0u);
    EXPECT_EQ(statements[0].values[0].root, 6u);
    EXPECT_EQ(statements[1].values[0].first, 7u);
    EXPECT_EQ(statements[1].values[0].root, 7u);
    for (ast::ExprId id = 0; id < script.expressions.size(); ++id) {
        const auto& node = script.expressions[id].node;
        if (const auto* binary = std::get_if<ast::Binary>(&node)) {
            EXPECT_LT(binary->left, id);
            EXPECT_LT(binary->right, id);
        }
    }
    // Spans include the brackets of operands, but the span of a name is the name alone.
    const auto text = [&](ast::ExprId id) { return sources.text(script.expressions[id].span); };
    EXPECT_EQ(text(6), "f(1, (b - 2) * 3)");
    EXPECT_EQ(text(5), "(b - 2) * 3");
    EXPECT_EQ(text(3), "b - 2");
    EXPECT_EQ(sources.text(statements[0].span), "a: f(1, (b - 2) * 3)");
}

TEST(Parser, ReadsStatementsOfEveryForm) {
    EXPECT_EQ(tree_of("system s {\n"
                      "  a: 4; b: 5\n"
                      "  rate = a*b\n"
                      "  a' = rate +\n"
                      "       lap(a)\n"
                      "  b' += 1\n"
                      "  a >= 0; b <= 9 }\n"),
              "system s  # line 1\n"
              "    a: 4\n"
              "    b: 5\n"
              "    rate = (* a b)\n"
              "    a' = (+ rate (lap a))\n"
              "    b' += 1\n"
              "    a >= 0\n"
              "    b <= 9\n");
}

TEST(Parser, ReadsBlocks) {
    EXPECT_EQ(tree_of("domain { grid: 128, 64; boundary: periodic }\n"
                      "stage large: turing_spots\n{\n iterations: 10 }\n"
                      "stage small: turing_spots { } picture {\n color: large.b\n}"),
              "domain  # line 1\n"
              "    grid: 128, 64\n"
              "    boundary: periodic\n"
              "stage large: turing_spots  # line 2\n"
              "    iterations: 10\n"
              "stage small: turing_spots  # line 5\n"
              "picture  # line 5\n"
              "    color: large.b\n");
}

TEST(Parser, AClassicStageEndsAtTheNextOneOrAtABlock) {
    EXPECT_EQ(tree_of("system_name: turing_spots\na: 1\n\nsystem_name: stripes\nb: 2\n"
                      "picture { color: b }\n"),
              "system_name: turing_spots  # line 1\n"
              "    a: 1\n"
              "system_name: stripes  # line 4\n"
              "    b: 2\n"
              "picture  # line 6\n"
              "    color: b\n");
}

TEST(Parser, KeywordsAreNamesWhereNoBlockCanBegin) {
    EXPECT_EQ(tree_of("system s { stage: 1; domain = 2; picture' = system; use: 3; fn >= 4 }"),
              "system s  # line 1\n"
              "    stage: 1\n"
              "    domain = 2\n"
              "    picture' = system\n"
              "    use: 3\n"
              "    fn >= 4\n");
}

TEST(Parser, ReadsEveryExample) {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(CASCADE_SOURCE_DIR) + "/examples")) {
        if (entry.path().extension() != ".cascade") continue;
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        EXPECT_THAT(parse_text(text.str()).faults, IsEmpty()) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 15);
}

TEST(Parser, ReadsALoneExpression) {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script script;
    const SourceId good = sources.add("--show", "small.b - a");
    const auto expression = parse_expression(good, sources, script, diagnostics);
    ASSERT_TRUE(expression.has_value());
    EXPECT_EQ(expression->root, 2u);
    EXPECT_TRUE(diagnostics.empty());
    for (const char* text : {"", "a b", "a, b", "a; b", "(a", "a }"}) {
        Diagnostics faults;
        EXPECT_FALSE(parse_expression(sources.add("--show", text), sources, script, faults))
            << text;
        EXPECT_EQ(faults.error_count(), 1u) << text;
    }
}

TEST(Parser, ReadsOverrides) {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script script;
    parse_override(sources.add("--set", "large.ka=1/400"), sources, script, diagnostics);
    parse_override(sources.add("--set", "speed: -0.5"), sources, script, diagnostics);
    EXPECT_TRUE(diagnostics.empty());
    EXPECT_EQ(print_ast(script, sources), "set large.ka: (/ 1 400)\nset speed: (- 0.5)\n");
}

TEST(Parser, ExplainsWrongOverrides) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "1:1 the name of what to set is missing | write name=value or stage.name=value"},
        {"ka", "1:1 '=' is missing after 'ka' | write name=value or stage.name=value"},
        {"large.=3", "1:6 a name is missing after '.' | write name=value or stage.name=value"},
        {"ka=", "1:3 the value of 'ka' is missing"},
        {"ka=1,2", "1:5 one value ends before ',' | --set may be given again, once for each name"},
    };
    for (const auto& [text, fault] : cases) {
        Sources sources;
        Diagnostics diagnostics;
        ast::Script script;
        parse_override(sources.add("--set", text), sources, script, diagnostics);
        EXPECT_THAT(list_faults(diagnostics, sources), ElementsAre(fault)) << text;
    }
}

std::vector<std::string> faults_of_large(const std::string& value) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("large", "system_name: s\na: " + value + "\nb: ]\n");
    { const ast::Script script = parse(source, sources, diagnostics); }
    return list_faults(diagnostics, sources);
}

std::string repeat(const std::string& piece, int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += piece;
    return text;
}

TEST(LargeScripts, DepthAndLengthAreNoProblem) {
    // The parser has read the text as far as this line.
    const std::string last = "3:4 this ']' closes nothing";
    const int deep = 100'000, many = 1'000'000;
    EXPECT_THAT(faults_of_large(repeat("(", deep) + "1" + repeat(")", deep)), ElementsAre(last));
    EXPECT_THAT(faults_of_large(repeat("f(", deep) + "1" + repeat(")", deep)), ElementsAre(last));
    EXPECT_THAT(faults_of_large(repeat("-", deep) + "1"), ElementsAre(last));
    EXPECT_THAT(faults_of_large(repeat("2^", deep) + "1"), ElementsAre(last));
    EXPECT_THAT(faults_of_large(repeat("1+", many) + "1"), ElementsAre(last));
    EXPECT_THAT(faults_of_large(repeat("(", deep)),
                ElementsAre("2:100003 this '(' is never closed | "
                            "a ')' is missing before the statement ends",
                            last));
    EXPECT_THAT(faults_of_large(repeat("[", deep) + "p" + repeat("]", deep)),
                ElementsAre("2:4 '[ ]' can contain only one name of this stage | ( ) groups an "
                            "expression",
                            last));
}

TEST(LargeScripts, DeepTreesCanBePrinted) {
    const int deep = 100'000;
    const std::string tree = tree_of("system_name: s\na: " + repeat("-", deep) + "1");
    EXPECT_EQ(tree, "system_name: s  # line 1\n    a: " + repeat("(- ", deep) + "1" +
                        repeat(")", deep) + "\n");
}

TEST(LargeScripts, AreRefusedAboveALimit) {
    EXPECT_THAT(parse_text(std::string(largest_script + 1, ' ')).faults,
                ElementsAre(
                    "1:1 this script has 16777217 bytes, but at most 16777216 can be read"));
    EXPECT_THAT(parse_text(std::string(most_tokens + 1, '(')).faults,
                ElementsAre("1:1 this script has more than 4194304 words"));
}

}  // namespace
}  // namespace cascade
