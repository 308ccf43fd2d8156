// What is wrong with functions, families, derived systems and ranges, and how it is told.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The faults of a text before a sound system with one stage.
std::vector<std::string> faults_of(const std::string& text) { return check_text(text)->faults(); }

const std::string sound = "\nsystem s { u: 1; u' = 1 }\nstage a: s { iterations: 3 }";

TEST(FunctionFaults, Definitions) {
    const std::string reads = " | a function reads its parameters and built-in values only";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"fn f(x) = f(x)",
         "1:11: the function 'f' calls itself | a function cannot be computed by itself"},
        {"fn f(x) = 1 + g(x); fn g(a) = h(a, a); fn h(a, b) = f(a)",
         "1:15: functions call each other in a cycle: f -> g -> h -> f | "
         "a function cannot be computed by itself"},
        {"fn sin(x) = x", "1:4: 'sin' is a function of the language | choose another name"},
        {"fn sum(x) = x", "1:4: 'sum' is a function of the language | choose another name"},
        {"fn f(a, a) = a", "1:9: 'a' is a parameter twice"},
        {"fn f(a) = 1; fn f(b) = 2", "1:17: there are two functions 'f'"},
        {"fn f(a) = seed", "1:11: 'seed' is not a parameter of the function 'f'" + reads},
        {"fn f(width) = widht",
         "1:15: 'widht' is not a parameter of the function 'f' | did you mean 'width'?"},
        {"fn f(a) = [u]", "1:11: a function cannot read a stage or a system" + reads},
        {"fn f(a) = a.u", "1:11: a function cannot read a stage or a system" + reads},
        {"fn f(a) = a'", "1:11: a function cannot read a stage or a system" + reads},
        {"fn f(a) = a[1]",
         "1:11: a function cannot read the member of a family | "
         "give it the member as an argument"},
        {"fn f(a) = sum(a over i)",
         "1:22: a function has no index 'i' | give it the members or their sum as arguments"},
        {"fn f(a) = g(a)", "1:11: there is no function 'g'"},
        {"fn wave(a) = a; fn f(a) = weve(a)",
         "1:27: there is no function 'weve' | did you mean 'wave'?"},
        {"fn g(a, b) = a; fn f(a) = g(a)",
         "1:27: g takes 2 values, not 1 | it is defined as g(a, b)"},
        {"fn f(a) = 1 +", "1:13: an expression is missing after '+'"},
    };
    for (const auto& [text, fault] : cases) {
        EXPECT_THAT(faults_of(text + sound), ElementsAre(fault)) << text;
        // Who calls it has done nothing wrong; with one fault there is one message.
        EXPECT_THAT(faults_of(text + "\nsystem s { u: f(1, 2); u' = 1 }").at(0), fault) << text;
    }
}

TEST(FunctionFaults, Calls) {
    const auto fault_in_rate = [](const std::string& rate) {
        return faults_of(
            "fn f(a, b) = a + b * random(0, 1)\nfn ink(v) = rgb(v, 0, 0)\n"
            "fn one() = 1\nfn now() = t\n"
            "system s { u: 1; p: 1; u' = " +
            rate + " + p; p >= 0*p }");
    };
    EXPECT_EQ(fault_in_rate("f(1)").at(0),
              "5:29: f takes 2 values, not 1 | it is defined as f(a, b)");
    EXPECT_EQ(fault_in_rate("one(1)").at(0),
              "5:29: one takes 0 values, not 1 | it is defined as one()");
    EXPECT_EQ(fault_in_rate("f(1, q)").at(0),
              "5:34: 'q' is not a parameter of s | add q: 0.1, for example");
    EXPECT_EQ(fault_in_rate("g(1)").at(0), "5:29: there is no function 'g'");
    EXPECT_EQ(fault_in_rate("ink(1)").at(0),
              "2:13: rgb cannot stand here | colours belong in pictures");
    EXPECT_EQ(fault_in_rate("f(1, \"tan\")").at(0),
              "5:34: a text can only name a palette or a file | "
              "palette(v, low, high, \"grey\"), field(\"a.npy\")");
    const auto value = check_text("fn now() = t\nsystem s { u: now(); u' = 1 }");
    const auto faults = value->diagnostics.sorted();
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].message, "'t' has no value when a stage starts");
    ASSERT_EQ(faults[0].notes.size(), 1u);
    EXPECT_EQ(value->sources.text(*faults[0].notes[0].span), "now()");
    EXPECT_THAT(faults_of("fn f(a) = 1 / (a - a * 0 - 2)\nsystem s { u: f(2); u' = 1 }"),
                ElementsAre("1:16: division by zero"));
}

TEST(FamilyFaults, Indices) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"i: 1..0", "1:12: the index 'i' has no values | the lower end comes first"},
        {"i: 1..1001", "1:12: the index 'i' has more than 1000 values"},
        {"i: 1..1e30", "1:18: an index runs over whole numbers from 0 on"},
        {"i: 0.5..2", "1:15: an index runs over whole numbers from 0 on"},
        {"i: -1..2", "1:15: an index runs over whole numbers from 0 on"},
        {"i: 1..p; p: 2; v: 1; v' = p",
         "1:18: the end of an index must be one number | "
         "only numbers, operators and functions of them can stand here"},
        {"i: 1..x", "1:18: the end of an index must be one number, but 'x' is varying by cell"},
        {"i: 1..2; i: 1..3", "1:21: 'i' is given a value twice"},
        {"i: 1..2; i: 4", "1:21: 'i' is given a value twice"},
        {"x: 1..2", "1:12: 'x' belongs to the language and cannot be an index"},
        {"speed: 1..2", "1:12: 'speed' belongs to the language and cannot be an index"},
        {"domain: 1..2", "1:12: 'domain' belongs to the language and cannot be an index"},
    };
    for (const auto& [text, fault] : cases) {
        EXPECT_THAT(faults_of("system s { " + text + "; u: 1; u' = 1 }"), ElementsAre(fault))
            << text;
    }
}

TEST(FamilyFaults, Members) {
    const auto faults_with = [](const std::string& statement) {
        return faults_of("system s { i: 1..3; u[i]: 1; p: 1; u[i]' = p; v: 0; v' = 1\n" +
                         statement + " }\nstage a: s { }");
    };
    const std::string members = " | there are u[1] to u[3]";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"v' += u[4]", "2:7: 'u[4]' is no member of its family" + members},
        {"v' += u[1.5]", "2:9: an index is a whole number, not 1.5"},
        {"v' += u[p]",
         "2:9: an index must be one number | "
         "only numbers, operators and functions of them can stand here"},
        {"v' += u[x]", "2:9: an index must be one number, but 'x' is varying by cell"},
        {"v' += u[1/0]", "2:11: division by zero"},
        {"v' += u", "2:7: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"v' += i",
         "2:7: the index 'i' has no value here | "
         "it has one in statements of u[i] and in sum(… over i)"},
        {"v' += p[1]", "2:7: 'p' is no family | write p without an index"},
        {"v' += w[1]", "2:7: 'w[1]' is not a parameter of s | did you mean 'u[1]'?"},
        {"v' += u[4]'", "2:7: 'u[4]' is no member of its family" + members},
        {"v' += sum(u[i] over j)",
         "2:21: there is no index 'j' | an index is declared in a system: i: 1..3"},
        {"v' += abs(u[i] over i)",
         "2:7: abs cannot be taken over an index | sum, product, mean, min and max can"},
        {"v' += abs(v over domain)",
         "2:7: abs cannot be taken over the domain | mean, sum, min and max can"},
        {"v' += product(v over domain)",
         "2:7: product cannot be taken over the domain | mean, sum, min and max can"},
        {"v' += sum(v)",
         "2:7: sum is taken over something | "
         "write sum(e over i) or sum(e over domain)"},
        {"w[j]: 1", "2:3: 'j' is not an index of s | it has i"},
        {"w[1.5]: 1", "2:3: the number of a member is whole"},
        {"u: 1", "1:21: 'u' cannot be a family and one quantity"},
        {"u = 1", "1:21: 'u' cannot be a family and one quantity"},
        {"u' = 1", "2:1: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"u >= 0", "2:1: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"u[7]' = 1", "2:1: 'u[7]' is no member of its family" + members},
        {"u[i]: 2", "2:1: 'u[1]' is given a value twice"},
        {"speed[i]: 1", "2:1: 'speed' is a setting and no family"},
        {"x[i]: 1", "2:1: 'x' is built in and cannot be declared"},
    };
    for (const auto& [statement, fault] : cases) {
        const auto faults = faults_with(statement);
        ASSERT_FALSE(faults.empty()) << statement;
        EXPECT_EQ(faults[0], fault) << statement;
    }
}

TEST(FamilyFaults, Stages) {
    const auto faults_with = [](const std::string& statement) {
        return faults_of(
            "system s { i: 1..2; u[i]: 1; p: 1; u[i]' = p }\nstage z: s { }\n"
            "stage a: s { " +
            statement + " }");
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"u: 1", "3:14: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"u[3]: 1", "3:14: 'u[3]' is no member of its family | there are u[1] to u[2]"},
        {"u[k]: 1", "3:16: 'k' is not an index of s | it has i"},
        {"p[i]: 1", "3:14: 'p' is no family | write p without an index"},
        {"u[i]: 1; u[i]: 2", "3:23: 'u[1]' is given a value twice"},
        {"u[1]: 1; u[1]: 2", "3:23: 'u[1]' is given a value twice"},
        {"p: u", "3:17: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"p: [u]", "3:18: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"p: z.u", "3:19: 'u' is a family | write u[1], or u[i] where i has a value"},
        {"p: u[i]",
         "3:19: the index 'i' has no value here | "
         "it has one in statements of u[i] and in sum(… over i)"},
        {"p: z.u[3]", "3:17: 'u[3]' is no member of its family | there are u[1] to u[2]"},
        {"i: 1..2",
         "3:14: a stage holds values only (name: …) | "
         "rates, definitions and bounds belong in a system"},
        {"p: 1 in 0 .. 2", "3:19: the range of a parameter stands in its system"},
    };
    for (const auto& [statement, fault] : cases) {
        const auto faults = faults_with(statement);
        ASSERT_FALSE(faults.empty()) << statement;
        EXPECT_EQ(faults[0], fault) << statement;
    }
}

TEST(DerivationFaults, AreToldOnce) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"system b: b { u: 1; u' = 1 }", "1:11: 'b' is derived from itself"},
        {"system b: c { } system c: d { } system d: b { u: 1 }",
         "1:11: systems are derived from each other in a cycle: b -> c -> d -> b"},
        {"system base { u: 1; u' = 1 } system b: bass { v' = 2 }",
         "1:40: there is no system 'bass'"},
        {"system base { u: 1; feed: 1; u' = feed } system b: base { fed: 2 }",
         "1:59: base has no 'fed' to change, and nothing reads it | did you mean 'feed'?"},
        {"system base { u: 1; u' = 1 } system b: base { rate = 2 }",
         "1:47: base has no 'rate' to change, and nothing reads it"},
        {"system base { u: 1; u' = 1 } system b: base { v' += 2 }",
         "1:47: species 'v' has no starting value | add v: …"},
        {"system base { u: 1; u' = 1 } system b: base { v >= 2 }",
         "1:47: 'v' is not a species of b"},
        {"system base { u: 1; u' = 1 } system b: base { u: 2; u: 3 }",
         "1:53: 'u' is given a value twice"},
        {"system base { u: 1; u' = 1 } system b: base { u' = 2; u' = 3 }",
         "1:55: the rate of 'u' is given twice"},
    };
    for (const auto& [text, fault] : cases) {
        EXPECT_THAT(faults_of(text + "\nstage a: b { }").at(0), fault) << text;
    }
    // Where the base is not known, nothing is known of what reads it.
    EXPECT_THAT(faults_of("system b: c { w' = q }\nstage a: b { r: 1 }\nstage z: a { r: a.r }"),
                ElementsAre("1:11: there is no system 'c'", "3:10: there is no system 'a'"));
}

TEST(RangeFaults, AreTold) {
    const auto faults_with = [](const std::string& statement) {
        return faults_of("system s { u: 1; u' = p\n" + statement + " }\nstage a: s { p: 9 }");
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"p: 1 in 2 .. 0", "2:6: a range goes from a lower to a higher number"},
        {"p: 1 in 2 .. 2", "2:6: a range goes from a lower to a higher number"},
        {"p: 1 in 0 .. u",
         "2:14: the end of a range must be one number | "
         "only numbers, operators and functions of them can stand here"},
        {"p: 1 in 0 .. 20 step 0",
         "2:6: the step of a range is above 0 and no longer than the range"},
        {"p: 1 in 0 .. 20 step 30",
         "2:6: the step of a range is above 0 and no longer than the range"},
        {"p: 21 in 0 .. 20", "2:4: warning: p is 21, outside of its range 0 .. 20"},
        {"p: 1 in 0 .. 2", "3:17: warning: p is 9, outside of its range 0 .. 2"},
        {"p: 1; v: 1 in 0 .. 2; v' = 0", "2:12: a range belongs to a parameter | 'v' is a species"},
    };
    for (const auto& [statement, fault] : cases) {
        EXPECT_THAT(faults_with(statement), ElementsAre(fault)) << statement;
    }
}

TEST(Expansion, IsBounded) {
    const auto begin = std::chrono::steady_clock::now();
    std::string doubling = "fn f0(x) = x + 1\n";
    for (int i = 1; i < 60; ++i) {
        doubling += fmt::format("fn f{}(x) = f{}(x) + f{}(x)\n", i, i - 1, i - 1);
    }
    const std::string large =
        "this expression is too large when its functions and families are "
        "written out | a script may grow to 1000000 parts";
    EXPECT_THAT(faults_of(doubling + "system s { u: f59(1); u' = f59(2) }"),
                ElementsAre("61:15: " + large));
    EXPECT_THAT(faults_of("system s { i: 1..1000; u: 1\n"
                          "u' = sum(sum(sum(i over i) over i) over i) }"),
                ElementsAre("2:6: " + large));
    std::string families = "system s { i: 1..1000; u: 1; u' = 1\n";
    for (int k = 0; k < 200; ++k) families += fmt::format("p{}[i]: 1\n", k);
    EXPECT_THAT(faults_of(families + "}").at(0),
                "101:1: the families of s are too large together | "
                "a system has at most 100000 statements");
    // A function of a million parts in a chain is no depth that could overflow.
    std::string chain = "fn f0(x) = x\n";
    for (int i = 1; i < 20'000; ++i) chain += fmt::format("fn f{}(x) = f{}(x) + 1\n", i, i - 1);
    EXPECT_THAT(faults_of(chain + "system s { u: f19999(1); u' = 1 }"), IsEmpty());
    std::string bases = "system b0 { u: 1; u' = 1 }\n";
    for (int i = 1; i < 1000; ++i)
        bases += fmt::format("system b{}: b{} {{ u: {} }}\n", i, i - 1, i);
    EXPECT_THAT(faults_of(bases), IsEmpty());
    std::string long_chain = "system b0 { u: 1; u' = 1 }\n";
    for (int i = 1; i < 3000; ++i)
        long_chain += fmt::format("system b{}: b{} {{ u' += 1 }}\n", i, i - 1);
    EXPECT_THAT(faults_of(long_chain),
                ElementsAre("1414:15: the systems of this script are too large together"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(Expansion, DumpsStayShort) {
    std::string doubling = "fn f0(x) = x + 1\n";
    for (int i = 1; i < 14; ++i) {
        doubling += fmt::format("fn g{0}(x) = x * x\nfn f{0}(x) = g{0}(f{1}(x))\n", i, i - 1);
    }
    std::string deep = doubling + "fn sq(x) = x * x\nsystem s { u: 1; u' = ";
    for (int i = 0; i < 60; ++i) deep += "sq(";
    deep += "u";
    for (int i = 0; i < 60; ++i) deep += ")";
    const auto checked = check_text(deep + " }\nstage a: s { }");
    ASSERT_THAT(checked->faults(), IsEmpty());
    EXPECT_LT(print_program(*checked->program).size(), 200'000u);
}

}  // namespace
}  // namespace cascade::testing
