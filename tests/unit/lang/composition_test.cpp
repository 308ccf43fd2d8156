// Functions, families and derived systems give the same program as statements written out by hand.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

using ::testing::IsEmpty;

/// The program as text, with all systems in use.
std::string program_of(const std::string& text) {
    const auto checked = check_text(text);
    EXPECT_THAT(checked->faults(), IsEmpty()) << text;
    return checked->program ? print_program(*checked->program) : "";
}

void expect_same_program(const std::string& short_text, const std::string& written_out) {
    const std::string program = program_of(short_text);
    EXPECT_NE(program, "");
    EXPECT_EQ(program, program_of(written_out));
}

const std::string run_s = "stage a: s { iterations: 3 }\n";

TEST(Functions, AreWrittenOut) {
    expect_same_program(
        "fn bump(r, w) = exp(-(r/w)^2)\nfn twice(v) = 2 * bump(v, width())\nfn width() = 3\n"
        "system s { u: twice(x) + bump(y, 1/2); u' = twice(u + 1) }\n" +
            run_s,
        "system s { u: 2 * exp(-(x/3)^2) + exp(-(y/(1/2))^2)\n"
        "u' = 2 * exp(-((u + 1)/3)^2) }\n" +
            run_s);
    // Parameters hide built-in values. Functions and quantities may have the same name.
    expect_same_program("fn f(x, t) = x + t * y\nsystem s { f: 1; u: f(4, 5); u' = f(u, f) }\n" +
                            run_s,
                        "system s { f: 1; u: 4 + 5 * y; u' = u + f * y }\n" + run_s);
    // Functions can be used in pictures, bounds, settings and numbers, too.
    expect_same_program(
        "fn half(a) = a / 2\nfn grey(v) = palette(v, 0, half(2), \"grey\")\n"
        "system s { u: 1; u' = 1; u >= half(p); p: 1; speed: half(1); iterations: half(8) }\n"
        "stage a: s { }\ndomain { grid: half(16), 8 }\npicture { color: grey(u) }",
        "system s { u: 1; u' = 1; u >= p / 2; p: 1; speed: 1 / 2; iterations: 4 }\n"
        "stage a: s { }\ndomain { grid: 8, 8 }\npicture { color: palette(u, 0, 1, \"grey\") }");
    // Texts can be arguments, too.
    expect_same_program(
        "fn seen(v, name) = palette(v, 0, 1, name)\n"
        "system s { u: 1; u' = 1; show: seen(u, \"grey\") }\n" +
            run_s,
        "system s { u: 1; u' = 1; show: palette(u, 0, 1, \"grey\") }\n" + run_s);
}

TEST(Functions, AnArgumentIsComputedOnce) {
    const auto checked = check_text(
        "fn square(a) = a * a\nfn first(a, b) = a\nsystem s {\n"
        "u: square(random(0, 1)); v: random(0, 1) * random(0, 1); w: first(2, random(0, 1))\n"
        "u' = v + w; v' = 1 }\n" +
        run_s);
    ASSERT_THAT(checked->faults(), IsEmpty());
    const System& system = system_named(*checked->program, "s");
    const auto draws = [&](std::size_t item) {
        const auto& nodes = system.quantities[ItemId(item)].start.nodes;
        return std::count_if(nodes.begin(), nodes.end(),
                             [](const Node& node) { return node.calls(Function::random); });
    };
    EXPECT_EQ(draws(0), 1);
    EXPECT_EQ(draws(1), 2);
    EXPECT_EQ(draws(2), 0);  // An argument that the function does not read is not computed.
    const Node& product = system.quantities[ItemId(0)].start.nodes.back();
    EXPECT_EQ(product.operands[0], product.operands[1]);
    EXPECT_EQ(only_number(system.quantities[ItemId(2)].start), 2);
}

TEST(Families, AreWrittenOut) {
    expect_same_program(
        "system s {\n i: 1..3\n j: 1 .. 1+1\n"
        " u[i]: i\n u[2]: 7\n k[j]: 1/(j+1)\n"
        " total = sum(u[i] over i); d[j] = k[j] * u[mod(j, 3) + 1]\n"
        " u[i]' = lap(u[i]) - total + sum(d[j] over j)\n u[3]' += product(u[i] over i)\n"
        " u[i]' += min(u[i] over i) + max(d[j]*i over j)\n"
        " u[i] >= 0; u[1] <= 9\n}\n" +
            run_s,
        "system s {\n"
        " u[1]: 1\n u[2]: 7\n u[3]: 3\n k[1]: 1/(1+1); k[2]: 1/(2+1)\n"
        " total = u[1] + u[2] + u[3]; d[1] = k[1] * u[2]; d[2] = k[2] * u[3]\n"
        " u[1]' = lap(u[1]) - total + (d[1] + d[2])\n"
        " u[1]' += min(min(u[1], u[2]), u[3]) + max(d[1]*1, d[2]*1)\n"
        " u[2]' = lap(u[2]) - total + (d[1] + d[2])\n"
        " u[2]' += min(min(u[1], u[2]), u[3]) + max(d[1]*2, d[2]*2)\n"
        " u[3]' = lap(u[3]) - total + (d[1] + d[2])\n"
        " u[3]' += u[1] * u[2] * u[3]\n"
        " u[3]' += min(min(u[1], u[2]), u[3]) + max(d[1]*3, d[2]*3)\n"
        " u[1] >= 0; u[2] >= 0; u[3] >= 0; u[1] <= 9\n}\n" +
            run_s);
    // A member's rate, a mean, an index within an index, and indices from 0.
    expect_same_program(
        "system s { i: 0..1; u[i]: 1; w[i]: 1; u[i]' = w[1 - i]; w[i]' = 2 * u[i]'\n"
        "speed: 0.5; w[0]' += mean(mean(u[i] over i) * i over i) }\n" +
            run_s,
        "system s { u[0]: 1; u[1]: 1; w[0]: 1; w[1]: 1; u[0]' = w[1]; u[1]' = w[0]\n"
        "w[0]' = 2 * u[0]'; w[1]' = 2 * u[1]'; speed: 0.5\n"
        "w[0]' += ((u[0] + u[1])/2 * 0 + (u[0] + u[1])/2 * 1) / 2 }\n" +
            run_s);
}

TEST(Families, TakeListsOfValues) {
    expect_same_program(
        "system s { i: 1..3; r[i]: 1, 0.9, 2 * i; u[i]: r[i]; u[i]' = r[i] * lap(u[i]) }\n" + run_s,
        "system s { i: 1..3; r[1]: 1; r[2]: 0.9; r[3]: 2 * 3; u[1]: r[1]; u[2]: r[2]; u[3]: r[3]\n"
        "u[1]' = r[1] * lap(u[1]); u[2]' = r[2] * lap(u[2]); u[3]' = r[3] * lap(u[3]) }\n" +
            run_s);
    // One member is overridden, a list of the base is replaced, and a stage has its own list.
    expect_same_program(
        "system b { i: 0..1; r[i]: 1, 2; u[i]: 0; u[i]' = r[i] }\n"
        "system s: b { r[i]: 3, 4; r[1]: 5 }\nstage a: s { r[i]: 6, 7 }\n",
        "system b { i: 0..1; r[0]: 1; r[1]: 2; u[i]: 0; u[i]' = r[i] }\n"
        "system s { i: 0..1; r[0]: 3; r[1]: 5; u[i]: 0; u[i]' = r[i] }\n"
        "stage a: s { r[0]: 6; r[1]: 7 }\n");
    const auto faults = [](const std::string& statement) {
        return check_text("system s { i: 1..3; r[i]: 1; u: 0; u' = r[2] }\nstage a: s { " +
                          statement + " }\n")
            ->faults();
    };
    EXPECT_THAT(faults("r[i]: 1, 2"),
                ::testing::ElementsAre("2:23: r[i] has 3 members, and the list 2 values | a family "
                                       "takes one value for all members, or one for each"));
    EXPECT_THAT(faults("r[i]: 1, 2, 3, 4"),
                ::testing::ElementsAre("2:29: r[i] has 3 members, and the list 4 values | a family "
                                       "takes one value for all members, or one for each"));
    EXPECT_THAT(faults("r[2]: 1, 2"), ::testing::ElementsAre("2:23: 'r' takes one value"));
}

TEST(Families, InStagesAndPictures) {
    const std::string system = "system s { i: 1..2; u[i]: 0; p[i]: 1; u[i]' = p[i] }\n";
    expect_same_program(
        system +
            "stage a: s { p[i]: i; p[2]: 5 }\n"
            "stage b: s { u[i]: u[i] + [p[i]] + a.p[3 - i]; p[i]: mean(u[i] over i) * i }\n"
            "picture { color: palette(sum(u[i] over i) + a.u[1], 0, 1, \"tan\") }",
        system +
            "stage a: s { p[1]: 1; p[2]: 5 }\n"
            "stage b: s { u[1]: u[1] + [p[1]] + a.p[2]; u[2]: u[2] + [p[2]] + a.p[1]\n"
            "p[1]: (u[1] + u[2]) / 2 * 1; p[2]: (u[1] + u[2]) / 2 * 2 }\n"
            "picture { color: palette(u[1] + u[2] + a.u[1], 0, 1, \"tan\") }");
    const auto changed = check_text(system + run_s, {"p[i]=4", "a.p[2]=3*2"});
    ASSERT_THAT(changed->faults(), IsEmpty());
    EXPECT_EQ(only_number(changed->program->stages[0].items[ItemId(2)]), 4);
    EXPECT_EQ(changed->program->stages[0].items[ItemId(3)].nodes.size(), 3u);
}

TEST(Derivation, ReplacesAndAdds) {
    expect_same_program(
        "system base { a: 1; b: 2; p: 3; d = p * a; a' = d; a' += 1; b' = d; b' += 2\n"
        "a >= 0; a >= -1; a <= 5; speed: 0.5; iterations: 7 }\n"
        "system s: base { b' += lap(b); p: 4; a' = -d; q: 9; d = p + q; a >= 2; iterations: 8\n"
        "a' += 3 }\n" +
            run_s,
        "system s { a: 1; b: 2; p: 4; d = p + q; a' = -d; a' += 3; b' = d; b' += 2\n"
        "b' += lap(b); a <= 5; a >= 2; speed: 0.5; iterations: 8; q: 9 }\n" +
            run_s);
    // A system derived from a derived system that is written after it, with a definition in place
    // of a parameter, and with a new species.
    expect_same_program(
        "system s: middle { p = 2 * a; c: 1; c' = a }\nsystem middle: base { p: 5 }\n"
        "system base { a: 1; p: 3; a' = p }\n" +
            run_s,
        "system s { a: 1; p = 2 * a; a' = p; c: 1; c' = a }\n" + run_s);
}

TEST(Derivation, OfFamilies) {
    const std::string base =
        "system base { i: 1..2; u[i]: i; u[2]: 5; u[i]' = u[3 - i]\n"
        "u[i]' += 1; p[i]: 1; u[1]' += p[1] + p[2] }\n";
    expect_same_program(base + "system s: base { u[i]: 3; p[2]: 4; u[2]' = p[2] }\n" + run_s,
                        "system s { u[1]: 3; u[2]: 3; u[1]' = u[2]; u[1]' += 1; p[1]: 1; p[2]: 4\n"
                        "u[1]' += p[1] + p[2]; u[2]' = p[2] }\n" +
                            run_s);
    expect_same_program(base + "system s: base { i: 1..3; u[i]' = i * p[i] }\n" + run_s,
                        "system s { u[1]: 1; u[2]: 5; u[3]: 3; u[1]' = 1 * p[1]; u[2]' = 2 * p[2]\n"
                        "u[3]' = 3 * p[3]; p[1]: 1; p[2]: 1; p[3]: 1 }\n" +
                            run_s);
}

TEST(Derivation, OfSystemsOfTheLibrary) {
    const auto checked = check_text(
        "system gray_scott: gray_scott { feed: 0.014; kill: 0.045 }\nstage a: gray_scott { }\n"
        "system spots: turing_spots { ka: 1/100; b >= 0.5 }\nstage b: spots { }\n");
    ASSERT_THAT(checked->faults(), IsEmpty());
    const System& system = checked->program->system_of(0);
    EXPECT_FALSE(system.built_in);
    EXPECT_EQ(system.quantities[ItemId(2)].name, "feed");
    EXPECT_EQ(only_number(system.quantities[ItemId(2)].start), 0.014);
    EXPECT_EQ(checked->program->system_of(1).invariants.size(), 1u);
}

TEST(Parameters, RangesAndDocs) {
    const auto right = check_text(
        "## Two words.\nsystem base { title: \"The Base\"; cite: \"A. Author (1999)\"\n"
        "p: 0.5 in 0 .. 2*0.5 step 1/10  ## rate\nq: 1; u: 0 ## height\nu' = p + q }\n"
        "system s: base { p: 0.75; q: 2 in 1 .. 3 ## new\nabout: \"Waves.\" }\n"
        "stage a: base { p: 0.9 }\n");
    ASSERT_THAT(right->faults(), IsEmpty());
    const System& base = system_named(*right->program, "base");
    EXPECT_EQ(base.doc, "Two words.");
    EXPECT_EQ(base.title, "The Base");
    EXPECT_EQ(base.cite, "A. Author (1999)");
    EXPECT_EQ(base.quantities[ItemId(0)].doc, "rate");
    EXPECT_EQ(base.quantities[ItemId(2)].doc, "height");
    ASSERT_TRUE(base.quantities[ItemId(0)].range);
    EXPECT_EQ(base.quantities[ItemId(0)].range->high, 1);
    EXPECT_EQ(base.quantities[ItemId(0)].range->step, 0.1);
    const System& derived = system_named(*right->program, "s");
    EXPECT_EQ(derived.cite, base.cite);
    EXPECT_EQ(derived.about, "Waves.");
    EXPECT_EQ(derived.quantities[ItemId(0)].doc, "rate");
    EXPECT_TRUE(derived.quantities[ItemId(0)].range);
    EXPECT_EQ(derived.quantities[ItemId(1)].doc, "new");
    EXPECT_EQ(derived.quantities[ItemId(1)].range->low, 1);
}

}  // namespace
}  // namespace cascade::test
