// The systems of the library on a small model, and stopped runs on a model.
#include "lang/library/library.h"
#include "resumed_run.h"
#include "run/simulation/simulation.h"
#include "support/small_models.h"

#include <fmt/format.h>

#include <fstream>

namespace cascade {
namespace {

class ModelLibraryTest : public ResumedRunTest {
protected:
    void SetUp() override {
        ResumedRunTest::SetUp();
        ASSERT_TRUE(write_file(path("torus.obj"), test::small_torus_obj()));
    }
};

TEST_F(ModelLibraryTest, EverySystemTakesStepsOrIsRefusedInWords) {
    std::size_t run = 0;
    for (const LibraryText& each : library_texts()) {
        Script script =
            load(fmt::format("domain {{ mesh: \"torus.obj\"; cells: 300 }}\n"
                             "stage only: {} {{ iterations: 20 }}\n",
                             each.system_name()));
        if (!script.program) {
            EXPECT_NE(script.messages(false).find("on a model"), std::string::npos)
                << script.messages(false);
            continue;
        }
        ++run;
        auto simulation = Simulation::create(script, {"interp", 0, 1});
        ASSERT_TRUE(simulation) << each.system_name() << simulation.error().message;
        const auto started = (*simulation)->start_stage(0);
        ASSERT_TRUE(started) << each.system_name() << started.error().message;
        RunControl control;
        const auto end = (*simulation)->advance_stage(0, 20, control, {});
        EXPECT_TRUE(end) << each.system_name() << ": " << (end ? "" : end.error().message);
    }
    EXPECT_GT(run, library_texts().size() / 2);
}

TEST_F(ModelLibraryTest, StoppedRunsEndInTheSameBits) {
    const std::string text =
        "domain { mesh: \"torus.obj\"; cells: 700; seed: 3 }\n"
        "stage one: turing_spots { iterations: 300 }\n"
        "stage two: gray_scott { iterations: 100; solver: rkl1 }\n";
    // A saved run looks for the model beside the script file, if this file has the text of the
    // saved run.
    std::ofstream(path("test.cascade")) << text;
    run_whole(text);
    run_in_two_parts(text, "two", 40);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path("whole"))) {
        if (entry.path().extension() != ".npy") continue;
        ++files;
        EXPECT_EQ(read_file(entry.path(), 1u << 30).value(),
                  read_file(path("rest") / entry.path().filename(), 1u << 30).value_or(""))
            << entry.path().filename();
    }
    EXPECT_GT(files, 2u);
}

}  // namespace
}  // namespace cascade
