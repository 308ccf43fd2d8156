// Messages of the parser for texts that are no scripts, and its tree for scripts with errors.
// tests/scripts/syntax has messages about scripts with errors.
#include "lang/syntax/parse.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>
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

TEST(ScriptFaults, AnEmptyScriptSaysSo) {
    const std::string fault =
        "1:1 this script is empty | a script begins with 'system_name: turing_spots', for example";
    EXPECT_THAT(faults_of(""), ElementsAre(fault));
    EXPECT_THAT(faults_of(std::string("\0", 1)),
                ElementsAre("1:1 a NUL byte (0x00) is not text | is this file a script?"));
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
