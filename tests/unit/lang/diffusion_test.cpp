// The implicit parts that semi-implicit solvers find in rates: operators and their factors.
#include "lang/calculus/diffusion.h"

#include "lang/print/print_formula.h"
#include "lower_helpers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cascade::test {
namespace {

/// The factors of u that are not 0, as "place: largest value".
std::vector<std::string> factors_of(const std::string& rate) {
    const auto checked =
        check_text("system s {\n u: 0.25 + 0.5 * sx\n v: 3\n k: 2\n h: 1 + sy\n u' = " + rate +
                   "\n v' = 0.5 * lap(v)\n}\nstage one: s { }\ndomain { grid: 2, 2 }\n");
    EXPECT_TRUE(checked->program) << rate << checked->faults().front();
    const Program& program = *checked->program;
    ScriptRun run(program);
    run.start(0);
    const auto found = diffusion_of(program, 0);
    EXPECT_EQ(found.size(), 2u);
    std::vector<std::string> result;
    for (std::size_t k = 0; k < diffusion_terms; ++k) {
        const Formula& formula = found.front()[k];
        if (formula.nodes.empty()) continue;
        const Field values = std::move(run.view(formula, 0)[0]);
        float largest = values.at(0, 0);
        for (std::int64_t j = 0; j < 2; ++j) {
            for (std::int64_t i = 0; i < 2; ++i) largest = std::max(largest, values.at(i, j));
        }
        std::string text = std::to_string(k) + ": " + std::to_string(largest);
        while (text.back() == '0') text.pop_back();
        result.push_back(text + (changes_in_time(program, 0, formula) ? " changing" : ""));
    }
    return result;
}

using Texts = std::vector<std::string>;

TEST(Diffusion, OfOperatorsInEachOther) {
    EXPECT_EQ(factors_of("u - u^3"), Texts{});
    EXPECT_EQ(factors_of("lap(v)"), Texts{});
    EXPECT_EQ(factors_of("k * lap(u) + u * v"), Texts{"0: 2."});
    EXPECT_EQ(factors_of("lap(u) / 4 - lap(2 * u)"), Texts{"0: -1.75"});
    EXPECT_EQ(factors_of("-lap(lap(u)) - 2 * lap(u)"), (Texts{"0: -2.", "1: 1."}));
    EXPECT_EQ(factors_of("lap(lap(lap(u)))"), Texts{"2: 1."});
    // The factor is 3 u² − 1, where u is 0.375 or 0.625.
    EXPECT_EQ(factors_of("lap(u^3 - u - 0.5 * lap(u))"), (Texts{"0: 0.171875 changing", "1: 0.5"}));
    EXPECT_EQ(factors_of("dxx(u) + 3 * dyy(u)"), (Texts{"4: 1.", "5: 3."}));
}

TEST(Diffusion, OfFluxesAndDirections) {
    EXPECT_EQ(factors_of("div(k * grad(u)) - dx(u)"), Texts{"0: 2."});
    EXPECT_EQ(factors_of("div(-grad(u) / 4)"), Texts{"0: -0.25"});
    EXPECT_EQ(factors_of("div(h * grad(u))"), Texts{"0: 1.75"});
    EXPECT_EQ(factors_of("-div(J)\n J = q - 2 * q\n q = h * grad(u)"), Texts{"0: 1.75"});
    EXPECT_EQ(factors_of("lap(u) + dot(grad(v), grad(u))\n J = grad(u)"), Texts{"0: 1."});
    EXPECT_EQ(factors_of("div(u * grad(v))"), Texts{});
    EXPECT_EQ(factors_of("cos(t) * lap(u)"), Texts{"0: 1. changing"});
    EXPECT_EQ(factors_of("diffuse(u, 2, 1, 0)"), (Texts{"4: 4.", "5: 1."}));
    // At 45°, the differences along both axes get 2.5, and the mixed difference gets twice 1.5.
    EXPECT_EQ(factors_of("diffuse(u, 2, 1, pi / 4)"), (Texts{"4: 2.5", "5: 2.5", "7: 3."}));
    EXPECT_EQ(factors_of("diffuse(u, 1, 2, pi / 4)"), (Texts{"4: 2.5", "5: 2.5", "7: -3."}));
    // If the angle differs from cell to cell, 1.5 is added to both axes.
    EXPECT_EQ(factors_of("diffuse(u, 2, 1, pi / 4 + 0 * h)"), (Texts{"4: 4.", "5: 4."}));
    EXPECT_EQ(factors_of("random(1, 0.1) * lap(u)"), Texts{});
    EXPECT_EQ(factors_of("advect(1, 2, u) + grad2(u) + mean(u over domain)"), Texts{});
}

/// A reaction is no diffusion. Decay beside diffusion counts only if it is the same in all cells.
TEST(Diffusion, OfWhatDecays) {
    EXPECT_EQ(factors_of("-3 * u"), Texts{});
    EXPECT_EQ(factors_of("k * lap(u) - 3 * u + v^2"), (Texts{"0: 2.", "8: 3."}));
    EXPECT_EQ(factors_of("k * lap(u) + u"), (Texts{"0: 2.", "8: -1."}));
    EXPECT_EQ(factors_of("k * lap(u) - h * u"), Texts{"0: 2."});
    EXPECT_EQ(factors_of("k * lap(u) - u^2"), Texts{"0: 2."});
    EXPECT_EQ(factors_of("k * lap(u) - random(1, 0.1) * u"), Texts{"0: 2."});
}

}  // namespace
}  // namespace cascade::test
