// Maps that are finer than their cells: what the run says of them.
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
    // Of 512² texels more than half are on the surface: at least √(0.5 · 512² / 300) = 20.9 a cell.
    const std::string words = warnings_with(300);
    EXPECT_THAT(words, HasSubstr(" texels wide in maps of 512 texels: '--bake 128' shows as much"));
}

TEST_F(TexelDensityTest, CellsOfSomeTexelsAreNot) {
    EXPECT_THAT(warnings_with(3000), Not(HasSubstr("texels wide")));
}

}  // namespace
}  // namespace cascade
