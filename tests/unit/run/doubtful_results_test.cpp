// Scripts of a few lines that used to end without a word and with a wrong picture.
#include "run_fixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace cascade {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class DoubtfulResults : public RunTest {
protected:
    /// The warnings of a run about a result that is in doubt.
    std::vector<std::string> warnings_of(const std::string& text) {
        warnings_.clear();
        Script script = load(text);
        const RunReport report = run_well(script, request());
        if (warnings_.size() > report.remarks.size()) {
            EXPECT_THAT(report.remarks, IsEmpty()) << "more is said of what is in doubt";
        }
        return warnings_besides_remarks(report);
    }
};

// Neighbours that alternate.

std::string too_fast_diffusion(const std::string& domain, const std::string& rate = "lap(u)",
                               const std::string& settings = "speed: 0.3; iterations: 300") {
    return fmt::format(
        "system d {{ u: random(0.5, 0.1); u' = {}; u >= 0; u <= 1 }}\n"
        "domain {{ {} }}\nstage s: d {{ {} }}\n",
        rate, domain, settings);
}

TEST_F(DoubtfulResults, AChequerboardOfDomainsIsTold) {
    for (const char* domain :
         {"grid: 64, 64", "grid: 130, 128", "grid: 16, 16, 16",
          "grid: 96, 96; mask: disc(0.5, 0.5, 0.4)", "grid: 300", "grid: 80, 80; boundary: noflux",
          "grid: 80, 80; precision: double"}) {
        const std::string speed = domain == std::string("grid: 300") ? "0.6" : "0.3";
        EXPECT_THAT(warnings_of(too_fast_diffusion(domain, "lap(u)",
                                                   "speed: " + speed + "; iterations: 300")),
                    ElementsAre(
                        AllOf(HasSubstr("u alternates from cell to cell like a chequerboard"),
                              HasSubstr("the largest stable speed is about "))))
            << domain;
    }
}

TEST_F(DoubtfulResults, StripesOfOneAxisAreTold) {
    for (const char* rate : {"dxx(u)", "dyy(u) + 0.1 * dxx(u)", "diffuse(u, 1.5, 0.3, 0)"}) {
        EXPECT_THAT(warnings_of(
                        too_fast_diffusion("grid: 90, 90", rate, "speed: 0.6; iterations: 300")),
                    ElementsAre(HasSubstr("u alternates from cell to cell")))
            << rate;
    }
}

TEST_F(DoubtfulResults, AlternatingPartsAreTold) {
    for (const char* part : {"0.5", "0.1"}) {
        const std::string rate = fmt::format("(0.1 + 0.9 * (sx < {})) * lap(u)", part);
        EXPECT_THAT(warnings_of(too_fast_diffusion("grid: 100, 100", rate)),
                    ElementsAre(HasSubstr("u alternates from cell to cell")))
            << part;
    }
}

TEST_F(DoubtfulResults, AChequerboardOnAModelIsTold) {
    const auto warnings =
        warnings_of(too_fast_diffusion("surface: sphere; cells: 1500", "lap(u)",
                                       "speed: 0.5; iterations: 300; solver: rk2"));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("u alternates from cell to cell")));
}

TEST_F(DoubtfulResults, TheWrongSignOfDiffusionIsTold) {
    EXPECT_THAT(warnings_of(
                    too_fast_diffusion("grid: 64, 64", "-lap(u)", "speed: 0.01; iterations: 1000")),
                ElementsAre(HasSubstr("because its rate makes differences of neighbours grow")));
}

TEST_F(DoubtfulResults, NoiseAndAFewCellsAreNoChequerboard) {
    for (const char* domain :
         {"grid: 4", "grid: 2, 1", "grid: 4, 4", "grid: 8", "grid: 64, 64", "grid: 300, 200"}) {
        EXPECT_THAT(warnings_of(fmt::format(
                        "system n {{ u: random(0, 1); u' = 0.1 * normal(0, 1) - 0.5 * u }}\n"
                        "domain {{ {} }}\nstage s: n {{ iterations: 40 }}\n",
                        domain)),
                    IsEmpty())
            << domain;
    }
    EXPECT_THAT(warnings_of(
                    "system n { u: random(0.5, 0.1); u' = 0.2 * lap(u) }\ndomain { grid: 4 }\n"
                    "stage s: n { iterations: 1 }\n"),
                IsEmpty());
}

// Steps too long for the reaction.

TEST_F(DoubtfulResults, StepsTooLongForABoundedReactionAreTold) {
    EXPECT_THAT(warnings_of("system l { u: random(0.5, 0.1); u' = u*(1 - u) }\n"
                            "stage s: l { speed: 2.9; iterations: 500 }\n"),
                ElementsAre(AllOf(HasSubstr("u jumps back and forth from step to step"),
                                  HasSubstr("the largest stable speed is about "))));
    EXPECT_THAT(warnings_of("system l { u: random(0.5, 0.1); u' = -tanh(20*(u - 0.5)) }\n"
                            "stage s: l { speed: 1; iterations: 500 }\n"),
                ElementsAre(AllOf(
                    HasSubstr("u jumps back and forth from step to step, by up to 1 in 100 %"),
                    HasSubstr("the largest stable speed is about 0.1 and this stage's is 1; try "
                              "'speed: 0.09; iterations: 5556'"))));
    EXPECT_THAT(warnings_of("stage s: gray_scott { speed: 1.5; iterations: 5000 }\n"),
                ElementsAre(HasSubstr("the largest stable speed is about 1.5")));
    // One cell in twenty, and of a species that is not the first; a duration; a speed by cell.
    EXPECT_THAT(warnings_of("system l { w: 1; u: 0.4; w' = 0; u' = -40*(sx < 0.05)*u^3 + 0.01*(0.2 "
                            "- u); u >= -1; u <= 1 }\n"
                            "stage s: l { speed: 0.5; duration: 100.2 }\n"),
                ElementsAre(HasSubstr("u jumps back and forth from step to step")));
    EXPECT_THAT(warnings_of("system l { u: random(0.5, 0.1); u' = -tanh(20*(u - 0.5)) }\n"
                            "stage s: l { speed: 0.9 + 0.2*x; iterations: 500 }\n"),
                ElementsAre(HasSubstr("u jumps back and forth")));
    EXPECT_THAT(
        warnings_of("system l { u: random(0.5, 0.1); u' = 0.1*lap(u) - tanh(20*(u - 0.5)) }\n"
                    "stage s: l { speed: 1; iterations: 500; solver: imex }\n"),
        ElementsAre(AllOf(HasSubstr("u jumps back and forth"), HasSubstr("try 'speed: 0.5'"))));
}

// What the advice tells to write ends the fault, in as much time.
TEST_F(DoubtfulResults, TheAdviceHelps) {
    EXPECT_THAT(warnings_of("system l { u: random(0.5, 0.1); u' = -tanh(20*(u - 0.5)) }\n"
                            "stage s: l { speed: 0.09; iterations: 5556 }\n"),
                IsEmpty());
    const std::string fast = too_fast_diffusion("grid: 64, 64");
    const auto warnings = warnings_of(fast);
    ASSERT_THAT(warnings,
                ElementsAre(HasSubstr("try 'speed: 0.23; iterations: 392', or longer steps: "
                                      "'solver: rkl1; speed: auto; duration: 90'")));
    for (const char* advice :
         {"speed: 0.23; iterations: 392", "solver: rkl1; speed: auto; duration: 90"}) {
        EXPECT_THAT(warnings_of(too_fast_diffusion("grid: 64, 64", "lap(u)", advice)), IsEmpty())
            << advice;
    }
}

// Steps so long that shorter ones lead elsewhere.

std::string logistic(const std::string& settings) {
    return "system l { u: 0.3 + 0.1*sx; u' = u*(1 - u) }\nstage s: l { iterations: 300; " +
           settings + " }\n";
}

std::string carried(const std::string& velocity, const std::string& settings) {
    return fmt::format(
        "system c {{ u: disc(0.3, 0.5, 0.1); u' = -advect({}, u); u >= 0; u <= 1 }}\n"
        "domain {{ grid: 48, 48 }}\nstage s: c {{ {} }}\n",
        velocity, settings);
}

// 0.714 = 2/2.8 is a fixed point of the midpoint rule and not of the equation.
TEST_F(DoubtfulResults, FixedPointsOfTheSolverAloneAreTold) {
    EXPECT_THAT(
        warnings_of(logistic("solver: rk2; speed: 2.8")),
        ElementsAre(AllOf(
            HasSubstr("the time step is too large: 4 more steps would move u by 0, and 12 "
                      "steps of a third of the length by 0.29, to values that differ by 0.29"),
            HasSubstr("try 'speed: 0.93'"))));
    EXPECT_THAT(warnings_of(logistic("solver: rk4; speed: 3.2")),
                ElementsAre(HasSubstr("the time step is too large: 4 more steps")));
    EXPECT_THAT(warnings_of(logistic("solver: rk2; speed: 0.93")), IsEmpty());
}

TEST_F(DoubtfulResults, FlowOfMoreThanACellAStepIsTold) {
    EXPECT_THAT(warnings_of(carried("3, 0", "iterations: 100")),
                ElementsAre(
                    AllOf(HasSubstr("the time step is too large"), HasSubstr("move u by"))));
    EXPECT_THAT(warnings_of(carried("1.4, 0.3", "iterations: 60")),
                ElementsAre(HasSubstr("the time step is too large")));
    EXPECT_THAT(warnings_of(carried("3, 0", "speed: 0.33; iterations: 300")), IsEmpty());
    EXPECT_THAT(warnings_of(carried("0.9, 0", "iterations: 30")), IsEmpty());
}

// A step that is as long as the period of what drives the rate sees one moment of it alone.
TEST_F(DoubtfulResults, APeriodOfOneStepIsTold) {
    const std::string day =
        "system d { u: 0.5; u' = 0.05*(1 + cos(2*pi*t))*u*(1 - u) - 0.05*u }\nstage s: d { ";
    EXPECT_THAT(warnings_of(day + "iterations: 1000 }\n"),
                ElementsAre(HasSubstr("the time step is too large")));
    EXPECT_THAT(warnings_of(day + "speed: 0.1; iterations: 1000 }\n"), IsEmpty());
}

// What depends on the number of steps or on their length is another equation with shorter ones.
TEST_F(DoubtfulResults, StepsThatAreCountedAreNotDivided) {
    EXPECT_THAT(warnings_of(
                    "system n { u: 0.5; u' = 0.1*sin(3*step) }\nstage s: n { iterations: 100 }\n"),
                IsEmpty());
    EXPECT_THAT(warnings_of("system n { u: x; u' = 0.1*normal(0, 1)/sqrt([speed]) - 0.1*u }\n"
                            "stage s: n { iterations: 100 }\n"),
                IsEmpty());
}

// Changes that single precision cannot add.

TEST_F(DoubtfulResults, ChangesThatRoundingSwallowsAreTold) {
    const std::string creep =
        "system c { u: 1; v: 0.5 + 0.1*x; u' = 3e-8; v' = -1e-9*v }\n"
        "stage s: c { iterations: 1000000 }\ndomain { grid: 2, 1";
    EXPECT_THAT(
        warnings_of(creep + " }\n"),
        ElementsAre(AllOf(
            HasSubstr("a step would change u by about 3e-08, which is too little to be added to "
                      "values of 1 in single precision; of this stage about 0.03 is lost"),
            HasSubstr("'precision: double' in the domain"))));
    EXPECT_THAT(warnings_of(creep + "; precision: double }\n"), IsEmpty());
}

// A pattern that has come to rest is left with rates of the size of a rounding, too.
TEST_F(DoubtfulResults, RestIsNoLostChange) {
    for (const char* text :
         {"system c { u: 0.2; u' = 0.1*u*(1 - u) }\nstage s: c { iterations: 400000 }\ndomain { "
          "grid: 2 }\n",
          "system c { u: random(0.5, 0.4); u' = 0.1*lap(u) + 0.05*u*(1 - u)*(u - 0.3) }\n"
          "stage s: c { iterations: 300000 }\ndomain { grid: 12 }\n",
          "system c { u: random(5, 1); v: 2; u' = 0.1*lap(u) + 0.02*(1 - u*v); v' = 0.1*lap(v) + "
          "0.02*(u - v) }\n"
          "stage s: c { iterations: 300000 }\ndomain { grid: 12 }\n"}) {
        EXPECT_THAT(warnings_of(text), IsEmpty()) << text;
    }
}

// Clamped, oscillating, noisy, at rest, and steps near the limit, but below it.
TEST_F(DoubtfulResults, SoundRunsAreNotWarnedOf) {
    for (const char* text :
         {"stage s: turing_spots { ka: 1/40; iterations: 3000 }\n",
          "stage s: gray_scott { speed: 1.4; iterations: 1500 }\n", "stage s: wave { }\n",
          "stage s: fitzhugh_nagumo { }\n", "stage s: noisy_gray_scott { iterations: 300 }\n",
          "system l { u: 0.2; u' = u*(1 - u) }\nstage s: l { speed: 1.9; iterations: 500 }\n",
          "system l { u: 0.2; v: 1; u' = v; v' = -u }\n"
          "stage s: l { speed: 1; solver: symplectic; iterations: 400 }\n",
          "system l { u: random(1, 1); u' = -u; u >= 0.5 }\nstage s: l { speed: 1.8; iterations: "
          "100 }\n",
          "system l { u: x; u' = 0.1*sin(3*step) - 0.01*u }\nstage s: l { iterations: 100 }\n",
          "system l { u: x; v: 0.5; u' = 4*(u - u^3/3 - v); v' = 0.3*(u + 0.7 - 0.8*v) }\n"
          "stage s: l { speed: 0.2; iterations: 400 }\n",
          "system l { u: x; u' = -1.5*(u - sin(t)) }\nstage s: l { iterations: 100 }\n",
          "system l { u: x; u' = 0.3*u }\nstage s: l { iterations: 100 }\n"}) {
        EXPECT_THAT(warnings_of(text), IsEmpty()) << text;
    }
}

}  // namespace
}  // namespace cascade
