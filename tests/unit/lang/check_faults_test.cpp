// Wrong texts: each fault by line, column, text and hint, and nothing said twice.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> faults(const std::string& text,
                                const std::vector<std::string>& overrides = {}) {
    return check_text(text, overrides)->faults();
}

/// A stage of Turing's system with one statement, which is on line 2.
std::vector<std::string> stage_faults(const std::string& statement) {
    return faults("system_name: turing_spots\n" + statement + "\n");
}

/// A small sound system with more statements, the first on line 2.
std::vector<std::string> system_faults(const std::string& statements) {
    return faults("system s { a: 1; k: 2; a' = -k * a\n" + statements + "\n}\n");
}

TEST(CheckFaults, SoundTextsHaveNone) {
    EXPECT_THAT(faults("domain { seed: 2 }"), IsEmpty());
    EXPECT_THAT(stage_faults("ka: 1/200"), IsEmpty());
    EXPECT_THAT(system_faults(""), IsEmpty());
}

TEST(CheckFaults, UnknownNames) {
    EXPECT_THAT(faults("stage large: turing_sots { ka: 3 }"),
                ElementsAre("1:14: there is no system 'turing_sots' | "
                            "did you mean 'turing_spots'?"));
    EXPECT_THAT(stage_faults("betta: 3"),
                ElementsAre("2:1: 'betta' is not a parameter of turing_spots | "
                            "did you mean 'beta'?"));
    EXPECT_THAT(stage_faults("iteration: 3"),
                ElementsAre("2:1: 'iteration' is not a parameter of turing_spots | "
                            "did you mean 'iterations'?"));
    EXPECT_THAT(stage_faults("ka: [betta]"),
                ElementsAre("2:6: 'betta' is not a parameter of turing_spots | "
                            "did you mean 'beta'?"));
    EXPECT_THAT(stage_faults("ka: sinn(3)"),
                ElementsAre("2:5: there is no function 'sinn' | did you mean 'sin'?"));
    EXPECT_THAT(system_faults("a' += feed"),
                ElementsAre("2:7: 'feed' is not a parameter of s | add feed: 0.1, for example"));
    EXPECT_THAT(faults("domain { sed: 3 }"),
                ElementsAre("1:10: 'sed' is not a setting of the domain | did you mean 'seed'?"));
    EXPECT_THAT(faults("picture { colour: 3 }"),
                ElementsAre("1:11: 'colour' is not a setting of the picture | "
                            "write 'color: palette(u, 0, 1, \"leopard\")'"));
}

TEST(CheckFaults, NamesOfThePreviousStage) {
    const auto checked = check_text(
        "stage large: turing_spots {}\n"
        "stage small: turing_spots {\n"
        "  beta: betta\n"
        "}\n");
    EXPECT_THAT(checked->faults(), ElementsAre("3:9: 'betta' is not a parameter of turing_spots | "
                                               "did you mean 'beta'?"));
    const Diagnostic fault = checked->diagnostics.sorted().at(0);
    ASSERT_EQ(fault.notes.size(), 1u);
    EXPECT_EQ(fault.notes[0].message,
              "bare names read the previous stage 'large' "
              "(turing_spots: a, b, beta, diff_a, diff_b, ka)");

    EXPECT_THAT(stage_faults("ka: b"),
                ElementsAre("2:5: 'b' reads the previous stage, but this is the first stage | "
                            "[b] is the 'b' of this stage"));
    EXPECT_THAT(faults("stage one: turing_spots {}\nstage two: stripes { a: c }"),
                ElementsAre("2:25: 'c' is not a parameter of turing_spots | "
                            "[c] is the 'c' of this stage"));
}

TEST(CheckFaults, NamesOfOtherStages) {
    const std::string text =
        "stage one: turing_spots { a: two.b }\n"
        "stage two: turing_spots { a: two.b; b: on.b; beta: one.betta }\n";
    EXPECT_THAT(faults(text), ElementsAre("1:30: stage 'two' runs after this one | "
                                          "a stage can read earlier stages only",
                                          "2:30: 'two' is this stage itself | write [b]",
                                          "2:40: there is no stage 'on' | did you mean 'one'?",
                                          "2:56: 'betta' is not a parameter of turing_spots | "
                                          "did you mean 'beta'?"));
    EXPECT_THAT(system_faults("d = one.b; a' += d"),
                ElementsAre("2:5: a system cannot read a stage | "
                            "a system does not know what ran before it"));
}

TEST(CheckFaults, OneMistakeOneMessage) {
    // What reads an unknown stage, a faulty species or an unreadable expression stays silent.
    EXPECT_THAT(faults("stage one: turing_sots {}\nstage two: turing_spots { a: a; b: one.q }"),
                ElementsAre("1:12: there is no system 'turing_sots' | "
                            "did you mean 'turing_spots'?"));
    EXPECT_THAT(faults("system s { a: 1; a' = v - a; v' = a - v }"),
                ElementsAre("1:30: species 'v' has no starting value | add v: …"));
    EXPECT_EQ(stage_faults("ka: min(1, )").size(), 1u);
}

TEST(CheckFaults, SeveralAtOnce) {
    EXPECT_THAT(stage_faults("ka: qa\nbeta: sinn(1)\nbetta: 1\nspeed: 0"),
                ElementsAre("2:5: 'qa' reads the previous stage, but this is the first stage | "
                            "did you mean 'a'?",
                            "3:7: there is no function 'sinn' | did you mean 'sin'?",
                            "4:1: 'betta' is not a parameter of turing_spots | "
                            "did you mean 'beta'?",
                            "5:8: speed must be above 0"));
}

TEST(CheckFaults, ArgumentsAndTypes) {
    EXPECT_THAT(stage_faults("ka: min(1, 2, 3)"),
                ElementsAre("2:5: min takes 2 values, not 3 | the smaller; NaN if one is NaN"));
    EXPECT_THAT(stage_faults("ka: min(1) + max(b)"),
                ElementsAre("2:5: min takes 2 values, not 1 | "
                            "over all cells it is min(e over domain)",
                            "2:14: max takes 2 values, not 1 | "
                            "over all cells it is max(e over domain)",
                            "2:18: 'b' reads the previous stage, but this is the first stage | "
                            "[b] is the 'b' of this stage"));
    EXPECT_THAT(stage_faults("ka: disc(1, 2)"),
                ElementsAre("2:5: disc takes 3 or 4 values, not 2 | disc(x, y, r) or "
                            "disc(x, y, z, r): 1 within r of the point, else 0; 0..1 coordinates, "
                            "across periodic sides"));
    EXPECT_EQ(stage_faults("ka: box(1, 2, 3, 4, 5)").size(), 1u);
    EXPECT_THAT(stage_faults("ka: noise(0)"),
                ElementsAre("2:11: the scale of noise must be above 0"));
    EXPECT_THAT(stage_faults("ka: lattice(-0.1, 1)"),
                ElementsAre("2:13: the spacing must be above 0"));
    for (const char* octaves : {"0", "13", "2.5", "1e30"}) {
        const std::string text = std::string("beta: noise(0.1, ") + octaves + ")";
        EXPECT_THAT(stage_faults(text),
                    ElementsAre("2:18: octaves are a whole number from 1 to 12 | "
                                "it must be known before the run"));
    }
    EXPECT_THAT(stage_faults("beta: noise(0.1, [ka])"),
                ElementsAre("2:18: octaves are a whole number from 1 to 12 | "
                            "it must be known before the run"));
    EXPECT_THAT(stage_faults("ka: white(1)"),
                ElementsAre("2:5: white cannot stand here | "
                            "it belongs in rates and definitions of a system"));
    EXPECT_THAT(stage_faults("ka: mod(1, 0)"), ElementsAre("2:12: division by zero"));
    EXPECT_THAT(stage_faults("ka: mod(1, 2 - cos(0) * 2)"), ElementsAre("2:12: division by zero"));
    EXPECT_THAT(stage_faults("iterations: step"),
                ElementsAre("2:13: iterations must be one number | "
                            "only numbers, operators and functions of them can stand here"));
    EXPECT_THAT(stage_faults("iterations: disc(0, 0, 1)"),
                ElementsAre("2:13: iterations must be one number, but disc is varying by cell"));
    EXPECT_THAT(stage_faults("ka: rgb(1, 0, 0)"),
                ElementsAre("2:5: rgb cannot stand here | colours belong in pictures"));
    EXPECT_THAT(stage_faults("ka: 1 + \"a\""),
                ElementsAre("2:9: a text can only name a palette or a file | "
                            "palette(v, low, high, \"grey\"), field(\"a.npy\")"));
    EXPECT_THAT(stage_faults("ka: field(leopard)"),
                ElementsAre("2:11: a text in quotes is expected here | \"leopard\""));
    EXPECT_THAT(system_faults("a' += field(\"a.npy\")"),
                ElementsAre("2:7: field cannot stand here | it belongs in values (name: …)"));
    EXPECT_THAT(stage_faults("ka: integral(1)"),
                ElementsAre("2:5: there is no function 'integral' | write 'sum(u over domain)', on "
                            "a plane times the size of a cell"));
}

TEST(CheckFaults, TimeBelongsInSteps) {
    EXPECT_THAT(stage_faults("ka: t"),
                ElementsAre("2:5: 't' has no value when a stage starts | "
                            "it can be read in rates, definitions and pictures"));
    EXPECT_THAT(system_faults("a' += t + step"), IsEmpty());
    EXPECT_THAT(stage_faults("ka: a'"), ElementsAre("2:5: the rate a' cannot be read here | "
                                                    "rates can be read in rates and definitions"));
}

TEST(CheckFaults, Cycles) {
    EXPECT_THAT(stage_faults("a: [b]\nb: [ka]\nka: [a] + [beta]"),
                ElementsAre("2:4: values need each other in a cycle: a -> b -> ka -> a"));
    EXPECT_THAT(stage_faults("a: [a]"), ElementsAre("2:4: a needs itself: a -> a"));
    EXPECT_THAT(stage_faults("a: [b]\nb: [a]\nka: [beta]\nbeta: [ka]"),
                ElementsAre("2:4: values need each other in a cycle: a -> b -> a",
                            "5:7: values need each other in a cycle: beta -> ka -> beta"));
    EXPECT_THAT(system_faults("p = q + 1; q = p; a' += p"),
                ElementsAre("2:5: definitions and rates need each other in a cycle: "
                            "p -> q -> p"));
    EXPECT_THAT(system_faults("p = a'; a' += p"),
                ElementsAre("2:5: definitions and rates need each other in a cycle: "
                            "p -> a' -> p"));
    EXPECT_THAT(faults("system s { a: b; b: a; a' = b }\nstage one: s {}"),
                ElementsAre("1:15: values need each other in a cycle: a -> b -> a"));
    // A stage closes the cycle with a default of its system: b of stripes is a.
    EXPECT_THAT(faults("system_name: stripes\na: [d] + [b]"),
                ElementsAre("2:4: values need each other in a cycle: a -> d -> a"));
}

TEST(CheckFaults, Twice) {
    const auto checked = check_text("system_name: turing_spots\nka: 1\nka: 2\n");
    EXPECT_THAT(checked->faults(), ElementsAre("3:1: 'ka' is given a value twice"));
    const Diagnostic fault = checked->diagnostics.sorted().at(0);
    ASSERT_EQ(fault.notes.size(), 1u);
    EXPECT_EQ(checked->sources[0].locate(fault.notes[0].span.value().begin).line, 2u);

    EXPECT_THAT(system_faults("a: 3"), ElementsAre("2:1: 'a' is given a value twice"));
    EXPECT_THAT(system_faults("k = 3"), ElementsAre("2:1: 'k' is given a value twice"));
    EXPECT_THAT(system_faults("a' = 3"), ElementsAre("2:1: the rate of 'a' is given twice"));
    EXPECT_THAT(system_faults("a' += 3"), IsEmpty());
    EXPECT_THAT(faults("system s { a: 1; a' = a }\nsystem s { a: 1; a' = a }"),
                ElementsAre("2:8: there are two systems 's'"));
    EXPECT_THAT(faults("system stripes { a: 1; a' = a }\nsystem stripes { a: 1; a' = a }"),
                ElementsAre("2:8: there are two systems 'stripes'"));
    EXPECT_THAT(faults("stage s: stripes {}\nstage s: stripes {}"),
                ElementsAre("2:7: there are two stages 's'"));
    EXPECT_THAT(faults("domain { seed: 1 }\ndomain { seed: 2 }"),
                ElementsAre("2:1: there are two domain blocks"));
}

TEST(CheckFaults, Declarations) {
    EXPECT_THAT(system_faults("x: 3"), ElementsAre("2:1: 'x' is built in and cannot be declared"));
    EXPECT_THAT(system_faults("speed = 3"),
                ElementsAre("2:1: 'speed' is a setting and no definition | write speed: …"));
    EXPECT_THAT(system_faults("duration = 3"),
                ElementsAre("2:1: 'duration' is a setting and no definition | write duration: …"));
    EXPECT_THAT(system_faults("u' = 1"),
                ElementsAre("2:1: species 'u' has no starting value | add u: …"));
    EXPECT_THAT(faults("system s { a: 1 }"),
                ElementsAre("1:8: system 's' has no rates | a rate is written name' = …"));
    EXPECT_THAT(system_faults("d = 2; a' += d; d' = 3"),
                ElementsAre("2:1: 'd' is a species and cannot be a definition | "
                            "write d: … for its starting value"));
    EXPECT_THAT(system_faults("b: d; d = a; a' += b + d"),
                ElementsAre("2:4: 'd' is a definition and cannot be read here | "
                            "definitions can be read in rates and other definitions"));
    EXPECT_THAT(faults("stage s: stripes {\n a' = 3 }"),
                ElementsAre("2:2: a stage holds values only (name: …) | "
                            "rates, definitions and bounds belong in a system"));
    EXPECT_THAT(system_faults("unread: 3\nnobody = k"),
                ElementsAre("2:1: warning: parameter 'unread' is never read",
                            "3:1: warning: definition 'nobody' is never read"));
    // What cannot be parsed may be what reads it.
    EXPECT_THAT(system_faults("unread: 3\nnobody = k +"),
                ElementsAre("3:12: an expression is missing after '+'"));
}

TEST(CheckFaults, TextsInAWrongCallAreNoFurtherMistake) {
    EXPECT_THAT(stage_faults("b: field(\"a\", \"b\")"),
                ElementsAre("2:4: field takes 1 value, not 2 | "
                            "field(\"file.npy\"): the file's value at the cell"));
    EXPECT_THAT(stage_faults("b: feild(\"a\")"),
                ElementsAre("2:4: there is no function 'feild' | did you mean 'field'?"));
}

TEST(CheckFaults, Bounds) {
    EXPECT_THAT(system_faults("a >= -k * 2"), IsEmpty());
    EXPECT_THAT(system_faults("k >= 0"), ElementsAre("2:1: 'k' is not a species of s"));
    EXPECT_THAT(system_faults("a <= a + 1"),
                ElementsAre("2:6: a bound is made of numbers and parameters only | "
                            "'a' is a species"));
    EXPECT_THAT(system_faults("a <= random(1, 2)"),
                ElementsAre("2:6: random cannot stand here | "
                            "a bound is made of numbers and parameters only"));
    EXPECT_THAT(system_faults("a <= x"),
                ElementsAre("2:6: a bound is made of numbers and parameters only"));
}

TEST(CheckFaults, Numbers) {
    EXPECT_THAT(stage_faults("ka: 1/0"), ElementsAre("2:7: division by zero"));
    EXPECT_THAT(stage_faults("ka: 1/(2 - 1*2)"), ElementsAre("2:8: division by zero"));
    EXPECT_THAT(stage_faults("ka: 1/[beta]"), IsEmpty());
    EXPECT_THAT(stage_faults("speed: 0"), ElementsAre("2:8: speed must be above 0"));
    EXPECT_THAT(stage_faults("speed: 1 - 3"), ElementsAre("2:8: speed must be above 0"));
    EXPECT_THAT(stage_faults("interval: 0"), ElementsAre("2:11: interval must be at least 1"));
    EXPECT_THAT(stage_faults("iterations: -1"), ElementsAre("2:13: iterations must be at least 0"));
    EXPECT_THAT(stage_faults("iterations: 5/2"),
                ElementsAre("2:13: iterations must be a whole number"));
    EXPECT_THAT(stage_faults("iterations: 1e9 + 1"),
                ElementsAre("2:13: iterations must be at most 1000000000"));
    EXPECT_THAT(stage_faults("iterations: 100 * x"),
                ElementsAre("2:19: iterations must be one number, but 'x' is varying by cell"));
    EXPECT_THAT(stage_faults("iterations: random(9, 1)"),
                ElementsAre("2:13: iterations must be one number, but random is varying by cell"));
    EXPECT_THAT(stage_faults("iterations: [ka]"),
                ElementsAre("2:13: iterations must be one number | "
                            "only numbers, operators and functions of them can stand here"));
}

TEST(CheckFaults, Domains) {
    const auto side = "1:16: a side of the grid must be a whole number of at least 1";
    EXPECT_THAT(faults("domain { grid: 0, 4 }"), ElementsAre(side));
    EXPECT_THAT(faults("domain { grid: -3 }"), ElementsAre(side));
    EXPECT_THAT(faults("domain { grid: 2.5, 4 }"), ElementsAre(side));
    EXPECT_THAT(faults("domain { grid: 1, 1 }"),
                ElementsAre("1:16: a grid needs more than one cell"));
    EXPECT_THAT(faults("domain { grid: 65536, 32769 }"),
                ElementsAre("1:16: the grid is too large | the largest has 2147483648 cells"));
    EXPECT_THAT(faults("domain { grid: 65536, 32768 }"), IsEmpty());
    EXPECT_THAT(faults("domain { boundary: periodc }"),
                ElementsAre("1:20: the boundary is periodic or noflux | "
                            "did you mean 'periodic'?"));
    EXPECT_THAT(faults("domain { seed: 4294967296 }"),
                ElementsAre("1:16: seed must be a whole number from 0 to 4294967295"));
    EXPECT_THAT(faults("domain { seed: 1; seed: 2 }"),
                ElementsAre("1:19: 'seed' is given a value twice"));
}

TEST(CheckFaults, Models) {
    EXPECT_THAT(faults("domain { mesh: horse }"),
                ElementsAre("1:16: a mesh is the name of a file in quotes | "
                            "mesh: \"horse.ply\""));
    EXPECT_THAT(faults("domain { mesh: \"horse.ply\"; grid: 20, 20 }"),
                ElementsAre("1:29: a model has no grid | its cells are spread over it: cells: "
                            "20000, or --cells 20000"));
    EXPECT_THAT(faults("domain { mesh: \"horse.ply\"; surface: sphere }"),
                ElementsAre("1:29: a domain has a mesh or a surface, not both"));
    EXPECT_THAT(faults("domain { surface: torus(1) }"),
                ElementsAre(
                    "1:19: torus takes its two radii in brackets | surface: torus(1, 0.4)"));
    EXPECT_THAT(faults("domain { surface: torus(0.4, 1) }"),
                ElementsAre("1:19: the tube of a torus is thinner than its ring | "
                            "surface: torus(1, 0.4)"));
    EXPECT_THAT(faults("domain { surface: sphere; cells: 2.5 }"),
                ElementsAre("1:34: cells must be a whole number from 1 to 268435456 | cells: "
                            "20000, or --cells 20000"));
    EXPECT_THAT(faults("domain { surface: sphere; cells: edges }"),
                ElementsAre("1:34: cells are a number, faces or vertices"));
    EXPECT_THAT(faults("domain { surface: sphere; laplacian: cotan }"),
                ElementsAre("1:38: the laplacian of a model is fv or turk"));
    EXPECT_THAT(faults("domain { surface: sphere; unit: 0 }"),
                ElementsAre("1:33: the unit of length must be above 0"));
    EXPECT_THAT(faults("domain { cells: 100 }"),
                ElementsAre("1:10: only a domain with a model has this setting | "
                            "mesh: \"horse.ply\", surface: sphere or --mesh sphere makes it one"));
}

TEST(CheckFaults, Pictures) {
    const std::string stage = "stage one: turing_spots {}\n";
    EXPECT_THAT(faults(stage + "picture { color: palette(b, 0, 8, \"grey\") }"), IsEmpty());
    EXPECT_THAT(faults(stage + "picture { color: b }"),
                ElementsAre("2:18: color must be a colour | rgb(…) and palette(…) make colours"));
    EXPECT_THAT(faults(stage + "picture { color: palette(b, 0, 8, grey) }"),
                ElementsAre("2:35: a text in quotes is expected here | \"grey\""));
    EXPECT_THAT(faults(stage + "picture { color: palette(b, 0, 8, \"gray\") }"),
                ElementsAre("2:35: there is no palette 'gray' | did you mean 'grey'?"));
    EXPECT_THAT(faults(stage + "picture { color: if(b < 4, rgb(1,0,0), 1) }"),
                ElementsAre("2:40: if chooses between two numbers or two colours"));
    EXPECT_THAT(faults(stage + "picture { color: rgb(1,0,0) + 1 }"),
                ElementsAre("2:18: a colour is no number"));
    EXPECT_THAT(faults(stage + "picture { color: rgb(random(1, 2), 0, 0) }"),
                ElementsAre("2:22: random cannot stand here | "
                            "pictures have no randomness of their own"));
}

TEST(CheckFaults, Overrides) {
    const std::string text = "stage large: turing_spots {}\nstage small: stripes {}\n";
    EXPECT_THAT(faults(text, {"large.ka=1/400", "iterations=10", "p1=2"}), IsEmpty());
    EXPECT_THAT(faults(text, {"lage.ka=1"}),
                ElementsAre("1:1: there is no stage 'lage' | did you mean 'large'?"));
    EXPECT_THAT(faults(text, {"iteratoins=1"}),
                ElementsAre("1:1: no stage has a parameter 'iteratoins' | "
                            "did you mean 'iterations'?"));
    EXPECT_THAT(faults(text, {"large.p1=1"}),
                ElementsAre("1:7: 'p1' is not a parameter of turing_spots"));
    EXPECT_THAT(faults(text, {"ka=1/0"}), ElementsAre("1:6: division by zero"));
}

TEST(CheckFaults, VeryDeepAndVeryLong) {
    std::string deep = "system_name: turing_spots\nka: ";
    for (int i = 0; i < 100'000; ++i) deep += "1-(";
    deep += "q" + std::string(100'000, ')');
    EXPECT_THAT(faults(deep),
                ElementsAre("2:300005: 'q' reads the previous stage, but this is the first "
                            "stage"));
    std::string chain = "system_name: turing_spots\nka: 1";
    for (int i = 1; i < 1'000'000; ++i) chain += "+1";
    EXPECT_THAT(faults(chain), IsEmpty());
    std::string names = "system s { a: 1; a' = p0\n";
    for (int i = 0; i < 100'000; ++i) names += fmt::format("p{}: p{}\n", i, i + 1);
    names += "p100000: 1 }\nstage one: s {}";
    EXPECT_THAT(faults(names), IsEmpty());
}

}  // namespace
}  // namespace cascade::testing
