// What a script may not ask of a model: each has its message.
#include "run/compile.h"
#include "run/script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

std::string messages_of(const std::string& domain, const std::string& rate, const std::string& stage = "",
                        const Overrides& overrides = {}) {
    const Script script = load_script(
        "test",
        fmt::format("domain {{ {} }}\nsystem s {{ u: 1\n u' = {} }}\nstage one: s {{ iterations: 1; {} }}\n",
                    domain, rate, stage),
        ".", overrides);
    return script.messages(false);
}

constexpr const char* sphere = "surface: sphere; cells: 100";

TEST(ModelInput, OperatorsOfColumnsAndRowsAreRefused) {
    for (const char* rate :
         {"dxx(u)", "dyy(u)", "dzz(u)", "dxy(u)", "dxz(u)", "dyz(u)", "advect(1, 2, u)", "diffuse(u, 1, 1, 0)",
          "div(vector(u, u))", "div(tensor(1, 2, 0.3) * grad(u))"}) {
        EXPECT_NE(messages_of(sphere, rate).find("cannot be used on a model"), std::string::npos) << rate;
    }
    EXPECT_EQ(messages_of(sphere, "lap(u) + div(u^2 * grad(u)) + grad2(u) + dx(u)"), "");
}

TEST(ModelInput, SettingsOfPlanesAreRefused) {
    for (const char* word : {"grid: 20, 20", "boundary: periodic", "spacing: 2", "mask: x > 0.5"}) {
        const std::string name = std::string(word).substr(0, std::string(word).find(':'));
        EXPECT_NE(messages_of(fmt::format("{}; {}", sphere, word), "lap(u)").find("a model has no " + name),
                  std::string::npos) << word;
    }
    EXPECT_NE(messages_of(sphere, "lap(u)", "solver: imex").find("needs the waves of a grid"), std::string::npos);
    EXPECT_NE(messages_of(sphere, "lap(u)", "start: coarse(2)").find("coarser grid"), std::string::npos);
}

TEST(ModelInput, AMaskIsLeftAsideWhereAModelIsAskedFor) {
    Overrides overrides;
    overrides.model = "sphere";
    overrides.cells = "100";
    EXPECT_NE(messages_of("grid: 20, 20; mask: x > 5", "lap(u)", "", overrides)
                  .find("warning: a model has no mask: this is left aside"),
              std::string::npos);
    overrides.grid = GridSize{20, 20};
    EXPECT_NE(messages_of("grid: 20, 20", "lap(u)", "", overrides).find("a model or a grid, not both"),
              std::string::npos);
}

TEST(ModelInput, ItsStagesAreNotCompiledToObjectFiles) {
    Script script = load_script("test",
                                "domain { surface: sphere; cells: 100 }\nsystem s { u: 1\n u' = lap(u) }\n"
                                "stage one: s { iterations: 1 }\n", ".");
    ASSERT_TRUE(script.program);
    const auto compiled = compile_step(script, {});
    ASSERT_FALSE(compiled);
    EXPECT_EQ(compiled.error().message, "a stage on a model is not compiled to an object file");
}

}  // namespace
}  // namespace cascade
