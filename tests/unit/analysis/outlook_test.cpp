// Remarks on stages in which nothing will grow, and stages without such a remark.
#include "analysis/negative_diffusion.h"
#include "analysis/outlook.h"
#include "lang/library/library.h"
#include "tests/unit/analysis/closed_forms.h"

namespace cascade::test {
namespace {

std::string outlook_of(const std::string& text) {
    const auto script = check_text(text);
    EXPECT_TRUE(script->program) << text;
    if (!script->program) return "";
    return analysis::why_nothing_grows(*script->program, 0).value_or("");
}

const std::string noise = "u: [feed] + random(0, 0.01); v: [decay] / [feed] + random(0, 0.01)";

TEST(Outlook, SaysHowMuchMoreDiffusionWouldDo) {
    // (1 + 4.5 √(4 / d))² = 6 at the threshold of d = diff_v.
    const std::string words = outlook_of("stage s: brusselator { decay: 6; " + noise + " }");
    const double d = 4 * 4.5 * 4.5 / ((std::sqrt(6.0) - 1) * (std::sqrt(6.0) - 1));
    EXPECT_NE(words.find("no wave grows from its flat state u = 4.5, v = 1.3333"),
              std::string::npos)
        << words;
    EXPECT_NE(words.find(fmt::format("one would grow if v diffused {:.3g} times as fast",
                                     std::ceil(d / 32 * 100) / 100)),
              std::string::npos)
        << words;
}

TEST(Outlook, NamesFlatStatesInSmallUnits) {
    const std::string words = outlook_of(
        "system s { S: 1e-18; u: S + random(0, 1e-21); v: S / 2; u' = lap(u) + S - u; v' = "
        "lap(v) + u - "
        "2 * v }\nstage a: s { }");
    EXPECT_NE(words.find("flat state u = 1e-18, v = 5e-19"), std::string::npos) << words;
}

TEST(Outlook, SaysThatWavesDoNotFitTheDomain) {
    const std::string words =
        outlook_of("domain { grid: 5, 5 }\nstage s: brusselator { " + noise + " }");
    EXPECT_NE(words.find("fits the domain: such waves are 7.86 to 12.2 cells long"),
              std::string::npos)
        << words;
}

TEST(Outlook, SaysThatAStageEndsTooEarly) {
    const std::string words =
        outlook_of("stage s: brusselator { iterations: 1000; speed: 0.005; " + noise + " }");
    EXPECT_NE(words.find("it ends before anything can grow"), std::string::npos) << words;
}

TEST(Outlook, SaysNothingWhereAPatternMayGrow) {
    EXPECT_EQ(outlook_of("stage s: brusselator { " + noise + " }"), "");
    // A spot starts a pattern. Strong noise or a side may start one, too.
    EXPECT_EQ(outlook_of("stage s: gray_scott { }"), "");
    EXPECT_EQ(outlook_of("stage s: brusselator { decay: 6; u: [feed] + random(0, 2) }"), "");
    EXPECT_EQ(outlook_of("domain { grid: 64, 64; boundary: noflux }\n"
                         "stage s: brusselator { decay: 6; u.left: fixed(1); " +
                         noise + " }"),
              "");
}

std::string negative_diffusion_in(const std::string& text) {
    const auto script = check_text(text);
    EXPECT_TRUE(script->program) << text;
    if (!script->program) return "";
    return analysis::negative_diffusion(*script->program, 0).value_or("");
}
std::string with_rate(const std::string& rate) {
    return "system s { u: random(0.5, 0.1); v: 0; k: 2; m: x; t0: 1\nu' = -u\nv' = " + rate +
           " }\ndomain { grid: 16, 16 }\nstage a: s { iterations: 1 }\n";
}

TEST(Outlook, NamesANegativeDiffusionCoefficient) {
    for (const char* rate :
         {"-0.08 * lap(v)", "u - 0.04 * k * lap(v)", "lap(-0.08 * v) - v", "div(-0.08 * grad(v))",
          "-0.08 * (dxx(v) + dyy(v))", "0.02 * lap(v) - 0.1 * lap(v) + u"}) {
        EXPECT_NE(negative_diffusion_in(with_rate(rate))
                      .find("v has a negative diffusion coefficient, -0.08: "),
                  std::string::npos)
            << rate << ": " << negative_diffusion_in(with_rate(rate));
    }
}

TEST(Outlook, SaysNothingOfDiffusionThatDampsOrIsNotKnown) {
    for (const char* rate :
         {"0.08 * lap(v)", "-lap(v) - lap(lap(v))", "-0.08 * lap(u)", "-m * lap(v)", "-u * lap(v)",
          "-sin(t) * lap(v)", "lap(v^3 - v) - lap(lap(v))", "u - v", "0 * lap(v)"}) {
        EXPECT_EQ(negative_diffusion_in(with_rate(rate)), "") << rate;
    }
}

TEST(Outlook, NoScriptOfTheLibraryIsCalledIdle) {
    for (const LibraryText& each : library_texts()) {
        const auto script = check_text(std::string(each.text));
        ASSERT_TRUE(script->program) << each.file_name;
        const auto stages = static_cast<std::uint32_t>(script->program->stages.size());
        for (std::uint32_t stage = 0; stage < stages; ++stage) {
            EXPECT_EQ(analysis::why_nothing_grows(*script->program, stage).value_or(""), "")
                << each.file_name;
            EXPECT_EQ(analysis::negative_diffusion(*script->program, stage).value_or(""), "")
                << each.file_name;
        }
    }
}

}  // namespace
}  // namespace cascade::test
