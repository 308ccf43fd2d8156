// What the parser says of wrong scripts: line, column and text of every message, one for a mistake.
#include "lang/syntax/parse.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> faults_of(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    parse(sources.add("test", text), sources, diagnostics);
    return list_faults(diagnostics, sources);
}

/// A value of a statement, and the only message about it; its line is 2.
using ValueFault = std::pair<std::string, std::string>;

void expect_value_faults(const std::vector<ValueFault>& cases) {
    for (const auto& [text, fault] : cases) {
        // The statement after it is read again, and its fault found.
        const std::string script = "system_name: s\nq: " + text + "\nlast: *\n";
        std::vector<std::string> faults = faults_of(script);
        ASSERT_FALSE(faults.empty()) << text;
        EXPECT_THAT(faults.back(), testing::HasSubstr("before '*'")) << text;
        faults.pop_back();
        EXPECT_THAT(faults, ElementsAre(fault)) << text;
    }
}

TEST(ExpressionFaults, Brackets) {
    const std::string unclosed =
        " this '(' is never closed | a ')' is missing before the statement ends";
    expect_value_faults({
        {"(1 + 2", "2:4" + unclosed},
        {"f(1, (2)", "2:5" + unclosed},
        {"1 + (2 + (3)", "2:8" + unclosed},
        {"f(1,", "2:5" + unclosed},
        {"(1 + 2\nb >= 0", "2:4" + unclosed},
        {"(1 + 2; r: 3", "2:4" + unclosed},
        {"1 + 2)", "2:9 this ')' closes nothing"},
        {")", "2:4 this ')' closes nothing"},
        {"1]", "2:5 this ']' closes nothing"},
        {"(1 + 2]", "2:4 this '(' is closed by ']' | write ')' there"},
        {"[p", "2:4 this '[' is never closed | a ']' is missing after the name"},
        {"[p + 1]", "2:4 '[ ]' holds one name of this stage | ( ) groups an expression"},
        {"[]", "2:4 '[ ]' holds one name of this stage | ( ) groups an expression"},
        {"()", "2:4 an expression is missing after '('"},
        {"(a, b)",
         "2:6 ',' separates the arguments of a function | "
         "the name of a function is missing before '('"},
    });
}

TEST(ExpressionFaults, ATextThatIsNeverClosedTakesTheBracketsWithIt) {
    const std::string fault = " this text is never closed | a text ends with '\"' on its line";
    expect_value_faults({
        {"palette(b, 0, 8, \"grey)", "2:21" + fault},
        {"(1 + f(\"a.npy)", "2:11" + fault},
    });
    EXPECT_THAT(faults_of("stage s: t { q: f(\"a.npy) }\n"), ElementsAre("1:19" + fault));
    // Here nothing was lost in the text: the block is open for itself.
    EXPECT_THAT(faults_of("stage s: t {\n q: f(\"a.npy)\n"),
                ElementsAre("1:12 this '{' is never closed | stage 's' ends with '}'",
                            "2:7" + fault));
}

TEST(ExpressionFaults, AnExpressionAloneHasOneMessageToo) {
    const auto expression_faults = [](const std::string& text) {
        Sources sources;
        Diagnostics diagnostics;
        ast::Script script;
        parse_expression(sources.add("test", text), sources, script, diagnostics);
        return list_faults(diagnostics, sources);
    };
    EXPECT_THAT(expression_faults("b"), IsEmpty());
    EXPECT_THAT(expression_faults("}"), ElementsAre("1:1 the expression is missing"));
    EXPECT_THAT(expression_faults("b }"), ElementsAre("1:3 one expression ends before '}'"));
}

TEST(ExpressionFaults, MissingOperands) {
    expect_value_faults({
        {"", "2:2 the value of 'q' is missing"},
        {"1 +", "2:6 an expression is missing after '+'"},
        {"(1 +)", "2:7 an expression is missing after '+'"},
        {"f(1,)", "2:7 an expression is missing after ','"},
        {"f(,1)", "2:6 an expression is missing before ','"},
        {"1 + * 2", "2:8 an expression is missing before '*'"},
        {"* 2", "2:4 an expression is missing before '*'"},
        {"1 + + 2", "2:8 an expression is missing before '+'"},
        {"1,", "2:5 an expression is missing after ','"},
        {"not", "2:4 an expression is missing after 'not'"},
        {"large.",
         "2:4 a name is missing after 'large.' | p of an earlier stage is written stage.p"},
    });
}

TEST(ExpressionFaults, MissingOperators) {
    expect_value_faults({
        {"2 a", "2:6 an operator is missing before 'a' | write '2 * a' to multiply"},
        {"a b", "2:6 an operator is missing before 'b'"},
        {"(a)(b)", "2:7 an operator is missing before '(' | write '*' to multiply"},
        {"a [b]", "2:6 an operator is missing before '['"},
        {"a not b", "2:6 an operator is missing before 'not'"},
        {"3 b: 4", "2:6 'b' begins a second statement on this line | put ';' between them"},
        {"3 b' = 4", "2:6 'b' begins a second statement on this line | put ';' between them"},
        {"a.b.c",
         "2:7 '.' stands between the name of a stage and one of its names | write stage.p"},
        {"(a)'", "2:7 a prime stands directly after a name | write p' for a rate"},
        {"a ? b : c",
         "2:6 '?' has no meaning in the language | a choice is written if(condition, a, b)"},
        {"if(a : b)", "2:9 ':' has no place inside an expression"},
    });
}

TEST(ExpressionFaults, FormsOfOtherLanguages) {
    expect_value_faults({
        {"0 < a < 4", "2:4 comparisons do not chain | write '0 < a and a < 4'"},
        {"0 < a+1 <= b < c", "2:4 comparisons do not chain | write '0 < a+1 and a+1 <= b'"},
        {"f(a == b == c)", "2:6 comparisons do not chain | write 'a == b and b == c'"},
        {"if(a = 4, 1, 2)", "2:9 '=' inside an expression | write '==' to compare"},
        {"b = 4", "2:6 '=' inside an expression | write '==' to compare"},
        {"a ** 2", "2:6 '**' is not an operator of the language | write '^' for a power"},
        {"a && b", "2:6 '&&' is not an operator of the language | write 'and'"},
        {"a % 2", "2:6 '%' is not an operator of the language | write mod(a, b) for a % b"},
        {"+3", "2:4 numbers have no sign '+' | leave it out"},
        {"f(1, +3)", "2:9 numbers have no sign '+' | leave it out"},
        {"a + not b", "2:8 'not' cannot stand directly after '+' | put it in brackets: (not …)"},
        {"f('tan')", "2:6 a text stands in double quotes | write \"tan\""},
    });
}

TEST(ExpressionFaults, Numbers) {
    const std::string range =
        " number out of range | numbers other than 0 are from 1.18e-38 to 3.4e38";
    expect_value_faults({
        {"1e999", "2:4" + range},
        {"1 + 3.5e38", "2:8" + range},
        {"3.4028236e38", "2:4" + range},  // Rounds to infinity in single precision.
        {"1e-999", "2:4" + range},
        {"1e-39", "2:4" + range},
        {"3abc", "2:4 '3abc' is not a number | write '3 * abc'"},
    });
}

TEST(ExpressionFaults, GarbageIsToldOnce) {
    expect_value_faults({
        {"$ + 3", "2:4 '$' has no meaning in the language"},
        {"1 + $", "2:8 '$' has no meaning in the language"},
        {"1 $ 2 (", "2:6 '$' has no meaning in the language"},
        {"f(1, $ 3, (\n 4) + 2)", "2:9 '$' has no meaning in the language"},
        {"[$]", "2:5 '$' has no meaning in the language"},
    });
}

TEST(StatementFaults, WrongForms) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"ka 3", "2:1 ':' is missing after 'ka' | a statement is 'name: expression'"},
        {"ka", "2:1 ':' is missing after 'ka' | a statement is 'name: expression'"},
        {"ka 3 4 (", "2:1 ':' is missing after 'ka' | a statement is 'name: expression'"},
        {"a' : 3", "2:1 a rate is written with '=' or '+=' | write a' = …"},
        {"a' >= 3", "2:1 a rate is written with '=' or '+=' | write a' = …"},
        {"a == 3", "2:3 '==' compares and defines nothing | write '='"},
        {"a += 3", "2:3 only a rate has terms to add to | write a' +="},
        {"a > 3", "2:3 an invariant is written with '>=' | write '>='"},
        {"a < 3", "2:3 an invariant is written with '<=' | write '<='"},
        {"large.p: 3",
         "2:1 a statement sets a name of its own stage only | "
         "write the name without a stage"},
        {"[p]: 3", "2:1 no statement begins with '[' | a statement is 'name: expression'"},
        {"3: 4", "2:1 no statement begins with '3' | a statement is 'name: expression'"},
        {"and: 4", "2:1 'and' is a word of the language and cannot be a name"},
        {"): 4", "2:1 this ')' closes nothing"},
        {"a =", "2:3 the definition of 'a' is missing"},
        {"a' =", "2:4 the rate of 'a' is missing"},
        {"a >=", "2:3 the bound of 'a' is missing"},
        {"a = 1, 2", "2:6 only a value may be a list | write one expression"},
        {"sytem foo {\n a: 1\n}", "2:1 'sytem' begins no block | did you mean 'system'?"},
        {"foo {\n a: (\n}",
         "2:1 'foo' begins no block | blocks are system, stage, domain and picture"},
        {"{ a: 1 }", "2:1 no block begins here | blocks are system, stage, domain and picture"},
        {"}", "2:1 this '}' closes nothing"},
    };
    for (const auto& [text, fault] : cases) {
        std::vector<std::string> faults = faults_of("system_name: s\n" + text + "\nlast: *\n");
        ASSERT_FALSE(faults.empty()) << text;
        EXPECT_THAT(faults.back(), testing::HasSubstr("before '*'")) << text;
        faults.pop_back();
        EXPECT_THAT(faults, ElementsAre(fault)) << text;
    }
}

TEST(BlockFaults, Headers) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"system { a: 1 }", "1:1 this system has no name | write 'system NAME {'"},
        {"system: s { a: 1 }", "1:1 this system has no name | write 'system NAME {'"},
        {"stage { a: 1 }", "1:1 this stage has no name | write 'stage NAME: SYSTEM {'"},
        {"stage: t { a: 1 }", "1:1 this stage has no name | write 'stage NAME: SYSTEM {'"},
        {"stage s { a: 1 }",
         "1:7 stage 's' does not say its system | write 'stage NAME: SYSTEM {'"},
        {"stage s t { a: 1 }", "1:7 ':' is missing after 's' | write 'stage NAME: SYSTEM {'"},
        {"stage s: { a: 1 }",
         "1:8 stage 's' does not say its system | write 'stage NAME: SYSTEM {'"},
        {"domain: { a: 1 }", "1:7 ':' has no place after 'domain' | write 'domain {'"},
        {"picture p { a: 1 }", "1:9 'p' has no place after 'picture' | write 'picture {'"},
        {"system s\n a: 1 }", "1:8 '{' is missing after 's' | a block is written { statements }"},
        {"system s 3 4\n a: 1 }",
         "1:8 '{' is missing after 's' | a block is written { statements }"},
    };
    for (const auto& [text, fault] : cases) {
        EXPECT_THAT(faults_of(text + "\n"), ElementsAre(fault)) << text;
    }
}

TEST(BlockFaults, AnUnclosedBlockEndsAtTheNext) {
    EXPECT_THAT(faults_of("system s {\n a: 1\n"),
                ElementsAre("1:10 this '{' is never closed | system 's' ends with '}'"));
    EXPECT_THAT(faults_of("system s {\n a: 1\nstage t: s {\n b: *\n}\n"),
                ElementsAre("1:10 this '{' is never closed | system 's' ends with '}'",
                            "4:5 an expression is missing before '*'"));
    EXPECT_THAT(faults_of("domain {\n seed: 1\nsystem_name: s\n b: 2\n"),
                ElementsAre("1:8 this '{' is never closed | domain ends with '}'"));
    // Here the writer thought of a block in a block: its second bracket is no further mistake.
    EXPECT_THAT(faults_of("system s {\n a: 1\n picture { color: a }\n}\n"),
                ElementsAre("1:10 this '{' is never closed | system 's' ends with '}'"));
}

TEST(BlockFaults, ClassicStages) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"system_name:", "1:12 the name of a system is missing | write 'system_name: SYSTEM'"},
        {"system_name s", "1:1 ':' is missing after 'system_name' | write 'system_name: SYSTEM'"},
        {"system_name = s", "1:1 ':' is missing after 'system_name' | write 'system_name: SYSTEM'"},
        {"system_name: \"s\"",
         "1:14 '\"s\"' is not the name of a system | write 'system_name: SYSTEM'"},
        {"system_name: s t", "1:16 't' has no place after the name of a system"},
    };
    for (const auto& [text, fault] : cases) {
        EXPECT_THAT(faults_of(text + "\na: 1\n"), ElementsAre(fault)) << text;
    }
}

TEST(BlockFaults, StatementsOutsideOfStages) {
    EXPECT_THAT(faults_of("a: 1\nb: 2\nsystem_name: s\nc: 3\n"),
                ElementsAre(
                    "1:1 'a' belongs to no stage | a stage begins with 'system_name: SYSTEM'"));
    EXPECT_THAT(faults_of("sistem_name: s\nb: 2\n"),
                ElementsAre("1:1 'sistem_name' belongs to no stage | did you mean 'system_name'?"));
    EXPECT_THAT(
        faults_of("system_name: s\ndomain { seed: 1 }\nb: 2\nc: *\n"),
        ElementsAre("3:1 'b' belongs to no stage | a stage begins with 'system_name: SYSTEM'",
                    "4:4 an expression is missing before '*'"));
}

TEST(ScriptFaults, AnEmptyScriptSaysSo) {
    const std::string fault =
        "1:1 this script is empty | a script begins with 'system_name: turing_spots', for example";
    EXPECT_THAT(faults_of(""), ElementsAre(fault));
    EXPECT_THAT(faults_of("\n# only a remark\n\n"), ElementsAre(fault));
    EXPECT_THAT(faults_of(std::string("\0", 1)),
                ElementsAre("1:1 a NUL byte (0x00) is not text | is this file a script?"));
    EXPECT_THAT(faults_of("domain { seed: 1 }"), IsEmpty());
}

TEST(ScriptFaults, ManyAreFoundInOneGo) {
    EXPECT_THAT(
        faults_of("system_name: s\n"
                  "iterations 28000\n"
                  "a: (1 + 2\n"
                  "b: 3 +\n"
                  "c: 0 < a < 4\n"
                  "d: if(a = 4, 1e99, f(2)\n"
                  "e: 1\n"),
        ElementsAre("2:1 ':' is missing after 'iterations' | a statement is 'name: expression'",
                    "3:4 this '(' is never closed | a ')' is missing before the statement ends",
                    "4:6 an expression is missing after '+'",
                    "5:4 comparisons do not chain | write '0 < a and a < 4'",
                    "6:6 this '(' is never closed | a ')' is missing before the statement ends",
                    "6:9 '=' inside an expression | write '==' to compare",
                    "6:14 number out of range | "
                    "numbers other than 0 are from 1.18e-38 to 3.4e38"));
}

TEST(ScriptFaults, AValueThatCannotBeReadIsStillGiven) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("test", "system_name: s\na: 1 + f(2, )\n");
    const ast::Script script = parse(source, sources, diagnostics);
    ASSERT_EQ(script.blocks.size(), 1u);
    ASSERT_EQ(script.blocks[0].statements.size(), 1u);
    const ast::Expression value = script.blocks[0].statements[0].values.at(0);
    EXPECT_EQ(value.first, value.root);
    EXPECT_TRUE(std::holds_alternative<ast::Garbage>(script.expressions[value.root].node));
}

}  // namespace
}  // namespace cascade
