// The planner: the number of passes, values written to planes, and values computed again.
#include "check_helpers.h"

#include "lang/lower/lower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The plan of a step of a system of these statements.
StepPlan step_of(const std::string& statements,
                 PlanOptions options = {Materialise::when_cheaper, true}) {
    const auto checked = check_text("system s {\n" + statements + "\n}\nstage only: s {}\n");
    EXPECT_TRUE(checked->program) << statements;
    if (!checked->program) return {};
    StepPlan plan = plan_step(*checked->program, 0, options);
    for (const Pass& pass : plan.passes) EXPECT_EQ(verify(*pass.bound.kernel), "") << statements;
    return plan;
}

std::size_t passes(const std::string& rate) { return step_of("u: x; u' = " + rate).passes.size(); }

TEST(Plan, OnePassIsEnoughWithoutOperatorsInOperators) {
    EXPECT_EQ(passes("lap(u) - u^3"), 1u);
    EXPECT_EQ(passes("lap(u^3 - u)"), 1u);
    EXPECT_EQ(passes("div(u * grad(u)) + grad2(u) + advect(1, u, u) + diffuse(u, 1, u, x)"), 1u);
    EXPECT_EQ(passes("dx(u) * dy(u)"), 1u);
}

TEST(Plan, EveryLayerOfOperatorsTakesAPass) {
    EXPECT_EQ(passes("lap(lap(u))"), 2u);
    EXPECT_EQ(passes("lap(lap(lap(u)))"), 3u);
    EXPECT_EQ(passes("lap(lap(u)) + dx(lap(dy(u)))"), 3u);
    EXPECT_EQ(passes("div(lap(u) * grad(u))"), 2u);
    EXPECT_EQ(passes("div(div(u * grad(u)) * grad(lap(u)))"), 2u);
    EXPECT_EQ(passes("div(tensor(1, 2, lap(u)) * grad(u))"), 2u);
    EXPECT_EQ(passes("diffuse(u, 1, 2, lap(u))"), 1u) << "the tensor is the cell's own";
    EXPECT_EQ(passes("advect(dx(u), dy(u), u)"), 1u) << "so is the velocity";
}

TEST(Plan, PartsOfOneLayerShareAPass) {
    const StepPlan plan =
        step_of("u: x; v: y; u' = lap(lap(u) + v); v' = lap(lap(v)) + lap(lap(u) + v)");
    ASSERT_EQ(plan.passes.size(), 2u);
    EXPECT_EQ(plan.temporaries, 2u) << "equal parts are one part";
    EXPECT_EQ(plan.passes[0].targets.size(), 2u);
}

TEST(Plan, WhatIsDearIsWritten) {
    EXPECT_EQ(passes("lap(exp(u) * sin(u))"), 2u);
    EXPECT_EQ(passes("lap(random(u, 1))"), 2u);
    EXPECT_EQ(passes("lap(disc(0.5, 0.5, 0.1) * u)"), 2u);
    EXPECT_EQ(passes("div(tensor(1, 2, x + u) * grad(u))"), 2u) << "sine and cosine are expensive";
    EXPECT_EQ(passes("div(tensor(1, 2, 0.3) * grad(u))"), 1u);
    const std::string words = step_of("u: x; u' = lap(exp(u))").words;
    EXPECT_THAT(words, HasSubstr("2 passes, 1 temporary plane"));
    EXPECT_THAT(words, HasSubstr("exp(u) is written to a plane: u' reads it at 4 neighbours"));
    EXPECT_THAT(step_of("u: x; u' = lap(2 * u)").words,
                HasSubstr("2 * u is computed again at 4 neighbours for u'"));
}

TEST(Plan, CanBeForced) {
    const std::string rates = "u: x; u' = lap(exp(u)) + div(u^2 * grad(u + 1))";
    EXPECT_EQ(step_of(rates, {Materialise::never}).passes.size(), 1u);
    EXPECT_EQ(step_of(rates, {Materialise::always}).passes.size(), 2u);
    EXPECT_EQ(step_of(rates, {Materialise::always}).temporaries, 3u);
}

TEST(Plan, PlanesAreUsedAgain) {
    const StepPlan plan = step_of("u: x; u' = lap(lap(lap(lap(lap(u)))))");
    EXPECT_EQ(plan.passes.size(), 5u);
    EXPECT_EQ(plan.temporaries, 2u);
    // No pass reads a plane that it writes.
    for (const Pass& pass : plan.passes) {
        std::set<std::uint32_t> written;
        for (const PassTarget& target : pass.targets) {
            const auto* const temporary = std::get_if<TemporaryId>(&target.id);
            if (temporary != nullptr) written.insert(temporary->index());
        }
        for (const PlaneSource& source : pass.bound.fields) {
            const auto* const read = std::get_if<TemporaryId>(&source);
            EXPECT_FALSE(read != nullptr && written.contains(read->index()));
        }
    }
}

TEST(Plan, AggregatesStandBetweenPasses) {
    const StepPlan direct = step_of("u: x; u' = mean(u over domain) - u");
    ASSERT_EQ(direct.passes.size(), 1u) << "a species is a plane already";
    EXPECT_EQ(direct.passes[0].reductions.size(), 1u);
    const StepPlan written = step_of("u: x; u' = u * mean(u^2 over domain) + sum(u^2 over domain)");
    ASSERT_EQ(written.passes.size(), 2u);
    EXPECT_EQ(written.temporaries, 1u);
    EXPECT_EQ(written.passes[1].reductions.size(), 2u);
    EXPECT_EQ(step_of("u: x; u' = lap(u * mean(u over domain))").passes.size(), 1u)
        << "a number can be used at neighbours";
    EXPECT_EQ(step_of("u: x; u' = max(u - mean(u over domain) over domain) - u").passes.size(), 2u);
}

/// The number of step-invariant parts of a step of these statements.
std::uint32_t step_invariants(const std::string& statements) {
    return step_of(statements, {Materialise::when_cheaper, false, true}).step_invariants;
}

TEST(Plan, WhatNoStepChangesIsKept) {
    // The parameter is already in a plane, and one more operation is not worth another plane.
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = 2 * k * u"), 0u);
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = exp(k) * u"), 1u);
    EXPECT_EQ(step_invariants("u: x; u' = exp(u) * sin(t) + random(0, 1)"), 0u)
        << "all of it changes";
    EXPECT_EQ(step_invariants("u: x; k: 2; u' = exp(k) * u"), 0u) << "one number for all cells";
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = lap(k) * u"), 1u);
    EXPECT_EQ(step_invariants("u: x; u' = div((1 + x * y) * grad(u))"), 1u)
        << "needed at five cells";
    EXPECT_EQ(step_invariants("u: x; u' = (1 + x * y) * u"), 0u) << "needed at one";
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = u * mean(k^2 over domain)"), 1u);
    EXPECT_EQ(step_of("u: x; k: x * y; u' = u * mean(k^2 over domain)",
                      {Materialise::when_cheaper, false, true})
                  .passes.size(),
              1u);
    EXPECT_EQ(step_of("u: x; k: x; u' = exp(k) * u").step_invariants, 0u)
        << "only where it is asked for";
}

// Of four entries of two tensors that share a direction, the direction's sine and cosine are kept.
TEST(Plan, FewestOperationsAndPlanesTogether) {
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = diffuse(u, 1, 2, k)"), 2u);
    EXPECT_EQ(step_invariants("u: x; v: y; k: x * y\n"
                              "u' = diffuse(u, 1, 2, k); v' = diffuse(v, 3, 1, k)"),
              2u);
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = exp(exp(k)) * u"), 1u);
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = exp(exp(k)) * u + exp(k)"), 2u);
    EXPECT_EQ(step_invariants(
                  "u: x; k: x * y; a = exp(k); u' = (a + 1) * u + (a - 1) * (a + 2) * u^2"),
              1u);
    EXPECT_THAT(
        step_of("u: x; k: x * y; u' = exp(k) * u", {Materialise::when_cheaper, true, true}).words,
        HasSubstr("exp(k) is computed once and kept in a plane"));
}

// A value is computed in each step if this takes no longer than to read it from a plane. The values
// to store are found by a cut of a network, which is fast for networks of any size.
TEST(Plan, ManyStepInvariantsArePlannedQuickly) {
    std::string deep = "k", wide = "u";
    for (int n = 0; n < 2000; ++n) deep = "(" + deep + " * k + 1)";
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = u * " + deep), 1u);
    for (int n = 0; n < 500; ++n) wide += fmt::format(" + u^{} * (exp(k) + {} * k)", n % 5, n);
    EXPECT_EQ(step_invariants("u: x; k: x * y; u' = " + wide), 1u);
}

/// The plan of a step of a system with sides.
StepPlan sided(const std::string& statements, const std::string& domain, PlanOptions options) {
    const auto checked = check_text("system s {\n" + statements + "\n}\ndomain { grid: 8, 8; " +
                                    domain + " }\nstage only: s {}\n");
    EXPECT_TRUE(checked->program) << statements;
    return checked->program ? plan_step(*checked->program, 0, options) : StepPlan{};
}

TEST(Plan, ValuesBeyondABorderAreNamed) {
    EXPECT_THAT(sided("u: x; w: y; u' = div(w * grad(u)); u.border: slope(-u)",
                      "mask: x > 0.5; boundary: noflux", {Materialise::when_cheaper, true})
                    .words,
                HasSubstr("u beyond the border is computed again at 4 neighbours for grad(u)"));
}

TEST(Plan, WhatIsOpenAtSidesIsComputedThere) {
    const std::string open = "boundary: noflux; left: fixed(1)";
    const PlanOptions writing{Materialise::always, true};
    EXPECT_EQ(sided("u: x; u' = lap(exp(u))", open, writing).passes.size(), 1u);
    EXPECT_EQ(sided("u: x; u' = lap(exp(u))", "boundary: noflux", writing).passes.size(), 2u);
    // The inner operator is written to a plane. mu depends on its value and on u, and is computed
    // again around each cell.
    const StepPlan plan = sided("u: x; mu = exp(u) - lap(u); u' = lap(mu)", open, writing);
    EXPECT_EQ(plan.passes.size(), 2u);
    EXPECT_EQ(plan.temporaries, 1u);
    EXPECT_THAT(plan.words, HasSubstr("mu is computed again at 4 neighbours for u': beyond a side "
                                      "it depends on the values there"));
    EXPECT_EQ(plan.passes[0].targets[0].boundary, Boundaries(Boundary::no_flux));
    // An aggregate of an expression reads a plane of its values. An operator computes the
    // expression again.
    EXPECT_EQ(sided("u: x; u' = lap(exp(u)) - mean(exp(u) over domain)", open, writing).temporaries,
              1u);
    // A species with sides in a periodic domain.
    const StepPlan shut = sided("u: x; u.sides: noflux; u' = lap(lap(u))", "seed: 1", writing);
    EXPECT_EQ(shut.passes[0].targets[0].boundary.x, Boundary::no_flux);
    EXPECT_EQ(shut.passes[0].targets[0].boundary.y, Boundary::no_flux);
}

TEST(Plan, UnusedDefinitionsTakeNoPass) {
    EXPECT_EQ(step_of("u: x; waste = lap(lap(u)); u' = lap(u)").passes.size(), 1u);
}

TEST(Plan, WideAndDeepFormulasArePlannedQuickly) {
    std::string deep = "u";
    for (int k = 0; k < 2000; ++k) deep = "(" + deep + " * u + 1)";
    EXPECT_EQ(passes("lap(" + deep + ")"), 2u);
    std::string wide = "u";
    for (int k = 0; k < 500; ++k) wide += fmt::format(" + lap(u * {} + lap(u) * {})", k, k);
    const StepPlan plan = step_of("u: x; u' = " + wide);
    EXPECT_EQ(plan.passes.size(), 2u);
    EXPECT_EQ(plan.temporaries, 500u);
}

TEST(PlanFaults, AreExplained) {
    const auto faults = [](const std::string& rate) {
        return check_text("system s {\nu: x\nu' = " + rate + "\n}").get()->faults();
    };
    const std::string numbers_of_vectors =
        "div(v), dot(v, w), length(v) and v.x turn a vector into a number";
    const std::string takes = " | write a name that differs from cell to cell, such as a species";
    EXPECT_THAT(faults("lap(3)"), ElementsAre("3:10: lap of a number is 0 everywhere" + takes));
    EXPECT_THAT(faults("div(u * grad(2 + 1))"),
                ElementsAre("3:19: grad of a number is 0 everywhere" + takes));
    EXPECT_THAT(faults("diffuse(1, 1, 1, 0)"),
                ElementsAre("3:14: diffuse of a number is 0 everywhere" + takes));
    EXPECT_THAT(faults("advect(u, u, 4)"),
                ElementsAre("3:19: advect of a number is 0 everywhere" + takes));
    EXPECT_THAT(faults("grad(u)"),
                ElementsAre("3:6: a vector is not a number | " + numbers_of_vectors));
    EXPECT_THAT(faults("u + grad(u)"),
                ElementsAre("3:6: a number and a vector cannot be added | "
                            "div(v), dot(v, w), length(v) and v.x are numbers"));
    EXPECT_THAT(faults("div(u)"), ElementsAre("3:10: div takes a vector | "
                                              "such as grad(e), d * grad(e) or vector(ex, ey)"));
    EXPECT_THAT(faults("div(grad(u) * grad(u))"),
                ElementsAre("3:10: a vector cannot be multiplied by a vector | "
                            "write dot(a, b) or cross(a, b) for a product of two vectors"));
    EXPECT_THAT(faults("div(grad(u) * tensor(1, 1, 0))"),
                ElementsAre("3:10: a vector cannot be multiplied by a tensor | "
                            "write the tensor before the vector"));
    EXPECT_THAT(faults("div(u / grad(u))"),
                ElementsAre("3:10: a number cannot be divided by a vector"));
    EXPECT_THAT(faults("tensor(1, 1, 0)"),
                ElementsAre("3:6: a tensor is not a number | "
                            "multiply it by a vector, as in div(tensor(a1, a2, theta) * grad(e))"));
    EXPECT_THAT(faults("sin(grad(u))"),
                ElementsAre("3:10: a vector is not a number | " + numbers_of_vectors));
    EXPECT_THAT(faults("div(if(u, grad(u), u))"),
                ElementsAre(
                    "3:25: if needs two numbers, two vectors or two colours to choose from"));
    EXPECT_THAT(faults("advect(1, u)"), ElementsAre("3:13: a vector is needed here | "
                                                    "such as grad(e) or vector(ex, ey)"));
    EXPECT_THAT(faults("advect(u)"), ElementsAre(HasSubstr("advect takes 2 to 4 values, not 1")));
    EXPECT_THAT(faults("u\nu >= lap(u)"),
                Contains("4:6: lap cannot be used here | "
                         "a bound can contain only numbers and parameters"));
    std::string deep = "u";
    for (int k = 0; k < 40; ++k) deep = "lap(" + deep + ")";
    EXPECT_THAT(faults(deep), ElementsAre(HasSubstr("operators are nested too deeply | "
                                                    "at most 32 levels")));
}

}  // namespace
}  // namespace cascade::test
