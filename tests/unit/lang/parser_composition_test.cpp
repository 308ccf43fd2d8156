// The parser: functions, families, ranges, systems from systems, doc comments and `use`.
#include "lang/syntax/parse.h"
#include "parsed_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cascade {
namespace {

using test::expression_of;
using test::parse_text;
using test::Parsed;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Expressions, MembersAndAggregates) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"u[i]", "(member u i)"},
        {"-u[i+1]^2", "(- (^ (member u (+ i 1)) 2))"},
        {"u[mod(i, 3) + 1]*2", "(* (member u (+ (mod i 3) 1)) 2)"},
        {"u[k[2]]", "(member u (member k 2))"},
        {"[u[i]]", "(member [u] i)"},
        {"[ u[\n i ]\n ]", "(member [u] i)"},
        {"large.u[2] + [b]", "(+ (member large.u 2) [b])"},
        {"u[i]' + v[1]'", "(+ (member u' i) (member v' 1))"},
        {"sum(u[i]*2 over i)", "(sum over i (* (member u i) 2))"},
        {"max(a + 1\n over domain)", "(max over domain (+ a 1))"},
        {"sum(over over over)", "(sum over over over)"},
        {"f(sum(a over i), min(b over j))", "(f (sum over i a) (min over j b))"},
        {"in", "in"},
    };
    for (const auto& [text, tree] : cases) {
        EXPECT_EQ(expression_of(text), tree) << text;
    }
}

TEST(Statements, FamiliesAndRanges) {
    const Parsed parsed = parse_text(
        "system s {\n"
        " i: 1..2 + 1\n j: 0 .. 4\n"
        " u[i]: 1 + i; u[2]: 5\n"
        " u[i]' = lap(u[i]) +\n   1\n u[i]' += 2\n"
        " d[i] = u[i+1]\n u[i] >= 0\n"
        " p: 0.03 in 0 .. 0.1\n q: 1 in -1 .. 2*3 step 1/2\n"
        " in: 4\n step_size: 1.5\n"
        "}\n");
    EXPECT_THAT(parsed.faults, IsEmpty());
    EXPECT_EQ(parsed.tree,
              "system s  # line 1\n"
              "    i: 1 .. (+ 2 1)\n    j: 0 .. 4\n"
              "    u[i]: (+ 1 i)\n    u[2]: 5\n"
              "    u[i]' = (+ (lap (member u i)) 1)\n    u[i]' += 2\n"
              "    d[i] = (member u (+ i 1))\n    u[i] >= 0\n"
              "    p: 0.03 in 0 .. 0.1\n    q: 1 in (- 1) .. (* 2 3) step (/ 1 2)\n"
              "    in: 4\n    step_size: 1.5\n");
}

TEST(Scripts, FunctionsUsesAndDerivedSystems) {
    const Parsed parsed = parse_text(
        "use \"noise.cascade\"\n"
        "fn bump(r, w) = exp(-(r/w)^2)\n"
        "fn golden() =\n  (1 + sqrt(5)) / 2\n"
        "system_name: s\nfn: 4\nfn f(a,\n b) = a\nuse: 5\nb: 6\n"
        "system t: s { a: 1 }\n");
    EXPECT_THAT(parsed.faults, IsEmpty());
    EXPECT_EQ(parsed.tree,
              "use \"noise.cascade\"\n"
              "fn bump(r, w) = (exp (- (^ (/ r w) 2)))\n"
              "fn golden() = (/ (+ 1 (sqrt 5)) 2)\n"
              "fn f(a, b) = a\n"
              "system_name: s  # line 5\n    fn: 4\n    use: 5\n    b: 6\n"
              "system t: s  # line 11\n    a: 1\n");
}

TEST(DocComments, BelongToWhatStandsThere) {
    const Parsed parsed = parse_text(
        "## Two words\n## and more.\n"
        "system s { ## on its line\n"
        "  ## before\n  # ordinary\n  a: 1 ## behind\n"
        "  b: 2; c: 3;  ## of c\n"
        "  d: (1 +  ## within\n 2)\n"
        "  ### a heading\n  e: 4 #\n  ##\n  f: 5 }\n"
        "## doubles\nfn f(x) = 2*x\n");
    EXPECT_THAT(parsed.faults, IsEmpty());
    const ast::Block& block = parsed.script.blocks.at(0);
    EXPECT_EQ(block.doc, "Two words and more. on its line");
    std::vector<std::string> docs;
    for (const ast::Statement& statement : block.statements) docs.push_back(statement.doc);
    EXPECT_THAT(docs, ElementsAre("before behind", "", "of c", "within", "", ""));
    EXPECT_EQ(parsed.script.functions.at(0).doc, "doubles");
}

TEST(DocComments, ThatBelongToNothingAreTold) {
    EXPECT_THAT(parse_text("system s {\n a: 1\n ## lost\n}\n## lost too").faults,
                ElementsAre("3:2 this '##' comment describes nothing | "
                            "write one '#' for an ordinary comment",
                            "5:1 this '##' comment describes nothing | "
                            "write one '#' for an ordinary comment"));
    EXPECT_THAT(parse_text("system s { a: 1 } ## behind\nsystem t { a: 1 }").faults,
                ElementsAre("1:19 this '##' comment describes nothing | "
                            "write one '#' for an ordinary comment"));
}

TEST(CompositionFaults, Expressions) {
    const std::string form = " | write sum(e over i) or mean(e over domain)";
    const std::string range = " | a range is written 1..3, or p: 1 in 0 .. 2";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"u[]", "2:5 an expression is missing after '['"},
        {"u[1, 2, 3]", "2:10 a family has at most two indices | write A[i, j]"},
        {"u[1,]", "2:7 an expression is missing after ','"},
        {"u[i", "2:5 this '[' is never closed | a ']' is missing before the statement ends"},
        {"(u[i)", "2:6 this '[' is never closed | a ']' is missing before the ')'"},
        {"[u[i] + 1]",
         "2:4 this '[' is never closed | the member of a family in this stage is written [u[i]]"},
        {"[u[i]]'", "2:10 a prime directly follows a name | write p' for a rate"},
        {"large.u[1]'", "2:14 a prime directly follows a name | write p' for a rate"},
        {"u'[1]", "2:6 an operator is missing before '['"},
        {"u [i]", "2:6 an operator is missing before '['"},
        {"(u)[i]", "2:7 an operator is missing before '['"},
        {"a over domain", "2:6 'over' belongs inside the brackets of a function" + form},
        {"(a over domain)", "2:7 'over' belongs inside the brackets of a function" + form},
        {"sum(a, b over i)", "2:13 'over' must follow a single expression" + form},
        {"sum(a over 3)", "2:10 'over' must be followed by an index or by 'domain'" + form},
        {"sum(a over i, 1)", "2:15 a ')' is missing after 'over i'" + form},
        {"sum(a over i", "2:15 a ')' is missing after 'over i'" + form},
        {"(1..2)", "2:6 '..' has no place inside an expression"},
        {"u[1..2]", "2:7 '..' has no place inside an expression"},
        {"1..2..3", "2:8 '..' has no place here" + range},
        {"1 in 0", "2:6 a range has two ends with '..' between them | write p: 1 in 0 .. 2"},
        {"1 in 0 .. 1 .. 2", "2:16 '..' has no place here" + range},
        {"1, 2 in 0 .. 1", "2:9 only the value of a parameter has a range | write p: 1 in 0 .. 2"},
        {"1 in ..", "2:9 an expression is missing before '..'"},
        {"1 in 0 .. 1 step", "2:16 the step of the range is missing"},
    };
    for (const auto& [text, fault] : cases) {
        const Parsed parsed = parse_text("system_name: s\nq: " + text + "\nz: 1\n");
        EXPECT_THAT(parsed.faults, ElementsAre(fault)) << text;
        EXPECT_THAT(parsed.tree, testing::HasSubstr("z: 1")) << text;
    }
}

TEST(CompositionFaults, Statements) {
    const std::string function = " | write 'fn name(a, b) = expression'";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"u[i+1]: 1",
         "2:1 the index in this statement must be a name or a whole number | write u[i] or u[1]"},
        {"u[1,2,3]: 1",
         "2:1 the index in this statement must be a name or a whole number | write u[i] or u[1]"},
        {"u[i] 3", "2:1 ':' is missing after 'u' | a statement is 'name: expression'"},
        {"u [i]: 3", "2:1 ':' is missing after 'u' | a statement is 'name: expression'"},
        {"u[i]: 1..2", "2:8 a range '..' can only declare an index | write i: 1..3"},
        {"i = 1..2", "2:6 a range '..' can only declare an index | write i: 1..3"},
        {"a = 1 in 0 .. 2", "2:7 only the value of a parameter has a range | write p: 1 in 0 .. 2"},
        {"fn f = 2", "2:4 '(' is missing after 'f'" + function},
        {"fn f(x { x }",
         "2:8 the parameters of 'f' must be names with commas between them" + function},
        {"fn f(x", "2:5 the parameters of 'f' must be names with commas between them" + function},
        {"fn f(x,", "2:5 the parameters of 'f' must be names with commas between them" + function},
        {"fn f(3) = 3",
         "2:6 the parameters of 'f' must be names with commas between them" + function},
        {"fn f(x) { x: ( }", "2:4 '=' is missing after the function 'f'" + function},
        {"fn f(x): x", "2:8 a function is written with '='" + function},
        {"fn f(x) =", "2:9 the value of the function 'f' is missing"},
        {"fn f(x) = x, x", "2:12 ',' has no place in a function | its value is one expression"},
        {"use noise", "2:5 the name of a file needs quotes | write use \"noise.cascade\""},
        {"use light.csv", "2:5 the name of a file needs quotes | write use \"light.csv\""},
        {"use \"a.cascade\", \"b.cascade\"", "2:16 ',' has no place after the name of a file"},
        {"domain { fn f(x) = 1; seed: 1 }",
         "2:10 'fn' belongs outside of blocks | write it at the top of the script"},
        {"domain { use \"a\"; seed: 1 }",
         "2:10 'use' belongs outside of blocks | write it at the top of the script"},
        {"system t: { b: 1 }",
         "2:9 the name of a system is missing after ':' | write 'system NAME: SYSTEM {'"},
    };
    for (const auto& [text, fault] : cases) {
        const Parsed parsed = parse_text("system_name: s\n" + text + "\nstage z: s { }\n");
        EXPECT_THAT(parsed.faults, ElementsAre(fault)) << text;
        EXPECT_THAT(parsed.tree, testing::HasSubstr("stage z")) << text;
    }
}

TEST(CompositionFaults, DepthAndLengthCostLittle) {
    std::string deep, wide;
    for (int i = 0; i < 200'000; ++i) deep += "u[";
    for (int i = 0; i < 100'000; ++i) wide += "sum(u[i]' over i) + ";
    EXPECT_EQ(parse_text("system_name: s\nq: " + deep).faults.size(), 1u);
    EXPECT_THAT(parse_text("system_name: s\nq: " + wide + "1").faults, IsEmpty());
}

}  // namespace
}  // namespace cascade
