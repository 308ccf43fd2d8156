// Warnings about maps that are much finer than the cells.
#include "run_fixture.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class TexelDensityTest : public RunTest {
protected:
    std::string warnings_with(std::int64_t cells) {
        Script script = load("system s { u: x; u' = 0 }\ndomain { surface: torus; cells: " +
                             std::to_string(cells) + " }\nstage a: s { iterations: 1 }\n");
        RunRequest wanted = request();
        wanted.outputs = {path("torus.glb")};
        wanted.model_files.bake = 512;
        run_well(script, wanted);
        std::string all;
        for (const std::string& warning : warnings_) all += warning + "\n";
        return all;
    }
};

TEST_F(TexelDensityTest, CellsOfManyTexelsAreNoticed) {
    // More than half of the 512² texels are on the surface, so a cell is at least √(0.5 · 512² /
    // 300) = 20.9 texels wide.
    const std::string words = warnings_with(300);
    EXPECT_THAT(words, HasSubstr(" texels wide in maps of 512 texels: '--bake 128' shows as much"));
}

TEST_F(TexelDensityTest, CellsOfSomeTexelsAreNot) {
    EXPECT_THAT(warnings_with(3000), Not(HasSubstr("texels wide")));
}

}  // namespace
}  // namespace cascade
