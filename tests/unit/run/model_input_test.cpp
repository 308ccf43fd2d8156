// Statements about a model that are refused, each with its message.
#include "core/file.h"
#include "lang/program/models.h"
#include "run/emit_c/compile.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace cascade {
namespace {

std::string messages_of(const std::string& domain, const std::string& rate,
                        const std::string& stage = "", const Overrides& overrides = {}) {
    const Script script = load_script("test",
                                      fmt::format("domain {{ {} }}\nsystem s {{ u: 1\n u' = {} "
                                                  "}}\nstage one: s {{ iterations: 1; {} }}\n",
                                                  domain, rate, stage),
                                      ".", overrides);
    return script.messages(false);
}

constexpr const char* small_sphere = "surface: sphere; cells: 100";

TEST(ModelInput, OperatorsOfColumnsAndRowsAreRefused) {
    for (const char* rate :
         {"dxx(u)", "dyy(u)", "dzz(u)", "dxy(u)", "dxz(u)", "dyz(u)", "advect(1, 2, u)",
          "transport(1, 2, u)", "curl(u).x", "div(symmetric(1, 2, 0.3) * grad(u))"}) {
        EXPECT_NE(messages_of(small_sphere, rate).find("cannot be used on a model"),
                  std::string::npos)
            << rate;
    }
    EXPECT_EQ(messages_of(small_sphere, "lap(u) + div(u^2 * grad(u)) + grad2(u) + dx(u)"), "");
    EXPECT_EQ(messages_of(small_sphere, "div(vector(u, u)) + diffuse(u, 1, 1, 0)"), "");
}

TEST(ModelInput, SettingsOfPlanesAreRefused) {
    for (const char* word : {"grid: 20, 20", "boundary: periodic", "spacing: 2", "mask: x > 0.5"}) {
        const std::string name = std::string(word).substr(0, std::string(word).find(':'));
        EXPECT_NE(messages_of(fmt::format("{}; {}", small_sphere, word), "lap(u)")
                      .find("a model has no " + name),
                  std::string::npos)
            << word;
    }
    EXPECT_NE(messages_of(small_sphere, "lap(u)", "solver: imex")
                  .find("works only on a grid, not on a model"),
              std::string::npos);
    EXPECT_NE(messages_of(small_sphere, "lap(u)", "start: coarse(2)").find("coarser grid"),
              std::string::npos);
}

TEST(ModelInput, MasksAndStencilsAreLeftAsideWhereAModelIsAskedFor) {
    Overrides overrides;
    overrides.model = "sphere";
    overrides.cells = "100";
    EXPECT_NE(messages_of("grid: 20, 20; mask: x > 5", "lap(u)", "", overrides)
                  .find("warning: this mask is ignored, because a model has no mask"),
              std::string::npos);
    EXPECT_NE(messages_of("grid: 20, 20; stencil: fourth", "lap(u)", "", overrides)
                  .find("warning: this stencil is ignored, because a model has no stencil"),
              std::string::npos);
    overrides.grid = GridSize{20, 20};
    EXPECT_NE(messages_of("grid: 20, 20", "lap(u)", "", overrides)
                  .find("<--grid>:1:1: error: a model has no grid"),
              std::string::npos);
}

TEST(ModelInput, MoreCellsThanMemoryAreRefusedBeforeTheyAreMade) {
    Script script = load_script("test",
                                "domain { surface: sphere; cells: 200000000 }\n"
                                "stage one: turing_spots { }\n",
                                ".");
    ASSERT_TRUE(script.program) << script.messages(false);
    SimulationOptions options{"interp", 0, 1};
    options.memory_limit = std::uint64_t{100} << 20;
    const auto made = Simulation::create(script, options);
    ASSERT_FALSE(made);
    EXPECT_TRUE(made.error().message.starts_with("the cells of this model need "))
        << made.error().message;
    EXPECT_NE(made.error().message.find("the limit (--limit-memory)"), std::string::npos);
    EXPECT_EQ(made.error().hint, "use fewer cells");
}

TEST(ModelInput, FacesAreCountedBeforeTheirMemoryIs) {
    const std::filesystem::path folder = ::testing::TempDir();
    ASSERT_TRUE(write_file(folder / "tetrahedron.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                           "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
    Script script = load_script("test",
                                "domain { mesh: \"tetrahedron.obj\"; cells: faces }\n"
                                "stage one: turing_spots { solver: rkl1 }\n",
                                folder);
    ASSERT_TRUE(script.program) << script.messages(false);
    SimulationOptions options{"interp", 0, 1};
    const auto free = Simulation::create(script, options);
    ASSERT_TRUE(free) << free.error().message;
    EXPECT_EQ((*free)->domain().grid, rows_of_cells(4));
    options.memory_limit = static_cast<std::uint64_t>((*free)->domain().memory);
    EXPECT_LT(options.memory_limit, 10'000);
    EXPECT_TRUE(Simulation::create(script, options));
    options.memory_limit -= 1;
    EXPECT_FALSE(Simulation::create(script, options));
}

TEST(ModelInput, AGridTakesThePlaceOfAModelAndThatIsSaid) {
    Overrides overrides;
    overrides.grid = GridSize{20, 30};
    const Script script =
        load_script("test", "domain { surface: sphere }\nstage one: turing_spots { }\n", ".",
                    overrides);
    ASSERT_TRUE(script.program) << script.messages(false);
    EXPECT_FALSE(script.program->domain.model);
    EXPECT_EQ(script.program->domain.grid, (Grid{20, 30}));
    EXPECT_NE(script.messages(false).find("warning: the requested grid replaces this model"),
              std::string::npos)
        << script.messages(false);
    const Script plane = load_script("test", "stage one: turing_spots { }\n", ".", overrides);
    EXPECT_EQ(plane.messages(false), "");
}

TEST(ModelInput, TheDumpedProgramHasTheModelAsItWasWritten) {
    for (const char* domain :
         {"surface: torus(1, 0.4)\n  cells: 300\n  laplacian: turk\n  unit: 0.125\n  seed: 4\n  "
          "precision: double",
          "mesh: \"horse.ply\"\n  cells: faces\n  up: z\n  seed: 1",
          "mesh: \"horse.ply\"\n  cells: 90\n  up: z\n  facing: x\n  seed: 1",
          "surface: creature\n  cells: 90\n  facing: -z\n  seed: 1",
          "surface: sphere\n  cells: 16384\n  directions: axis(0, 1, 0)\n  stretch: 3\n  seed: 1",
          "surface: creature\n  cells: 700\n  directions: curvature_low(0.5)\n  stretch: 2\n  "
          "seed: 1",
          "surface: box\n  cells: vertices\n  seed: 1",
          "surface: box\n  cells: 90\n  directions: keys(0, 0, 1, 0, 1, 0, 0.25)\n  stretch: 2\n  "
          "seed: 1"}) {
        const std::string text = fmt::format("domain {{\n  {}\n}}\n", domain);
        const Script script = load_script("test", text + "stage one: turing_spots { }\n", ".");
        ASSERT_TRUE(script.program) << text << script.messages(false);
        EXPECT_NE(print_program(*script.program).find(text), std::string::npos)
            << print_program(*script.program);
    }
    const Script script = load_script("test",
                                      "domain { surface: implicit(1 - x^2 - y^2 - z^4, 2) }\n"
                                      "stage one: turing_spots { }\n",
                                      ".");
    ASSERT_TRUE(script.program) << script.messages(false);
    const std::string printed = print_program(*script.program);
    EXPECT_NE(printed.find("surface: implicit("), std::string::npos) << printed;
    EXPECT_NE(printed.find(", 2)\n  cells: 16384"), std::string::npos) << printed;
}

TEST(ModelInput, ItsStagesAreNotCompiledToObjectFiles) {
    Script script =
        load_script("test",
                    "domain { surface: sphere; cells: 100 }\nsystem s { u: 1\n u' = lap(u) }\n"
                    "stage one: s { iterations: 1 }\n",
                    ".");
    ASSERT_TRUE(script.program);
    const auto compiled = compile_step(script, {});
    ASSERT_FALSE(compiled);
    EXPECT_EQ(compiled.error().message, "a stage on a model cannot be compiled to an object file");
}

}  // namespace
}  // namespace cascade
