// Values that are not numbers where no species ever shows it.
#include "run_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace cascade {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class UndefinedValues : public RunTest {
protected:
    /// The warnings of a run.
    std::vector<std::string> warnings_of(const std::string& text) {
        warnings_.clear();
        Script script = load(text);
        return warnings_besides_remarks(run_well(script, request()));
    }
};

TEST_F(UndefinedValues, OfParametersAreTold) {
    EXPECT_THAT(warnings_of(
                    "system s { k: sqrt(x - 0.5); u: 1; u' = if(k > 0.1, -0.01*u, 0.01*lap(u)) }\n"
                    "stage a: s { iterations: 10 }\n"),
                ElementsAre("stage 'a': k is not a number at column 0, row 0"));
    EXPECT_THAT(warnings_of(
                    "system s { k: 1/(x - x); u: 1; u' = -u/k }\nstage a: s { iterations: 10 }\n"),
                ElementsAre("stage 'a': k is infinite at column 0, row 0"));
    EXPECT_THAT(warnings_of("system s { k: log(0.5 - x); u: 1; u' = -0.01*u; u >= k }\nstage a: s "
                            "{ iterations: 10 }\n"),
                ElementsAre("stage 'a': k is not a number at column 32, row 0"));
    EXPECT_THAT(
        warnings_of(
            "system s { u: 1; k: 0; u' = -0.01*u*(1 + 0*k) }\nstage a: s { iterations: 10 }\n"
            "stage b: s { u: 1; k: if(log(mean(u over domain) - 5) < 0, 1, 2); iterations: 10 }\n"),
        ElementsAre(AllOf(
            HasSubstr("stage 'b': log(mean(u over domain) - 5) in the value of k is not a number"),
            HasSubstr("at the start: what compares it takes it for false"))));
}

TEST_F(UndefinedValues, OfBoundsAreTold) {
    EXPECT_THAT(warnings_of("system s { k: x; u: 1; u' = -0.01*u; u >= sqrt(k - 0.5) }\nstage a: s "
                            "{ iterations: 10 }\n"),
                ElementsAre("stage 'a': sqrt(k - 0.5) in the bound of u is not a number at column "
                            "0, row 0, at the start: "
                            "there is no bound there"));
}

TEST_F(UndefinedValues, InComparisonsOfRatesAreTold) {
    EXPECT_THAT(warnings_of("system s { u: 0.3 + 0.4*x; r = log(u - 0.5); u' = (r < 0)*0.001 "
                            "}\nstage a: s { iterations: 10 }\n"),
                ElementsAre("stage 'a': log(u - 0.5) in the rate of u is not a number at column 0, "
                            "row 0, at the start: "
                            "what compares it takes it for false"));
    // It was a number when the stage began.
    EXPECT_THAT(warnings_of("system s { u: 1 + 4*x; v: 0.1; u' = -0.1; v' = 0.01*(sqrt(u) < 0.5) "
                            "}\nstage a: s { iterations: 30 }\n"),
                ElementsAre(HasSubstr(
                    "sqrt(u) in the rate of v is not a number at column 0, row 0, after step 30")));
}

TEST_F(UndefinedValues, OfConditionsAreTold) {
    EXPECT_THAT(
        warnings_of("system s { a: random(1, 0.1); a' = 0.01*a }\n"
                    "stage b: s { until: max(log(a - 5) over domain) > 3; iterations: 300 }\n"),
        ElementsAre(
            "stage 'b': max(log(a - 5) over domain) in 'until' is not a number, after step 100: "
            "the stage does not end by it"));
    EXPECT_THAT(warnings_of("system s { u: 1; u' = -0.01*u }\nstage a: s { frozen: sqrt(x - 0.5) > "
                            "0.2; iterations: 10 }\n"),
                ElementsAre(HasSubstr(
                    "sqrt(x - 0.5) in the value of frozen is not a number at column 0, row 0")));
    EXPECT_THAT(warnings_of("system s { u: 1; u' = -0.01*u }\nstage a: s { frozen: sqrt(x - 0.5); "
                            "iterations: 10 }\n"),
                ElementsAre(
                    "stage 'a': frozen is not a number at column 0, row 0, which counts as true"));
}

TEST_F(UndefinedValues, OfMasksAreTold) {
    EXPECT_THAT(
        warnings_of("system s { u: 1; u' = -0.01*u }\ndomain { mask: sqrt(x - 0.5) > 0.2 }\n"
                    "stage a: s { iterations: 10 }\n"),
        ElementsAre(
            "the mask of the domain: sqrt(x - 0.5) is not a number at column 0, row 0, which is "
            "outside by it"));
}

// Nothing is said of values that no cell of the domain reads or no comparison uses.
TEST_F(UndefinedValues, ThatDoNotMatterAreNotTold) {
    for (const char* text :
         {"system s { u: 1; u' = if(u > 0.5 and sqrt(u - 0.5) > 0.3, -0.1, 0) + (u < 0)*(sqrt(-u) "
          "> 0.1) }\n"
          "stage a: s { iterations: 30 }\n",
          "system s { u: x - 0.5; u' = 0.01*if(u > 0, log(u) < -1, 0) - 0.01*u }\nstage a: s { "
          "iterations: 30 }\n",
          "system s { u: x - 0.5; u' = 0.01*(u <= 0 or 1/u < 5) - 0.01*u }\nstage a: s { "
          "iterations: 30 }\n",
          "system s { k: sqrt(x - 0.5); u: 1; u' = -0.01*u; u >= k - 5 }\ndomain { mask: x > 0.5 "
          "}\n"
          "stage a: s { iterations: 10 }\n",
          "system s { u: 1; u' = (exp(1000*u) > 2)*0.001 }\nstage a: s { iterations: 10 }\n"}) {
        EXPECT_THAT(warnings_of(text), IsEmpty()) << text;
    }
}

TEST_F(UndefinedValues, OfConstantsAreToldByTheCheck) {
    const Script script =
        load("system s { a: 1e38*1e38; u: 1; u' = a*u }\nstage b: s { iterations: 10 }\n");
    EXPECT_THAT(script.messages(false),
                AllOf(HasSubstr("test.cascade:1:15: warning: * has no finite value here"),
                      HasSubstr("1e+76 is infinite in single precision, which ends at 3.4e38")));
    EXPECT_EQ(load("system s { a: 1e38*3; u: 1; u' = a*u }\nstage b: s { iterations: 10 }\n")
                  .messages(false),
              "");
}

}  // namespace
}  // namespace cascade
