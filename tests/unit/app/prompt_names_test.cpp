// The names that completion offers depend on the words before the cursor.
#include "app/prompt_names.h"

#include "run/script/script.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace cascade {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::UnorderedElementsAre;

class PromptNames : public ::testing::Test {
protected:
    PromptNames()
        : script_(load_script("test", "system s { u: 1; k: 2; u' = k }\nstage one: s { }\n", ".")) {
    }
    std::vector<std::string> names(const std::string& line) const {
        return names_at_end(line, *script_.program);
    }
    Script script_;
};

TEST_F(PromptNames, AfterAStageItsItemsFollow) {
    EXPECT_THAT(names(":set one."), ElementsAre("u", "k", "frozen", "speed"));
    EXPECT_THAT(names("stage two: s { u: one.u"), ElementsAre("u", "k", "frozen", "speed"));
    EXPECT_THAT(names("nobody."), Contains("stage"));
}

TEST_F(PromptNames, CommandsTakeTheirOwnNames) {
    EXPECT_THAT(names(":goto o"), ElementsAre("one"));
    EXPECT_THAT(names(":set "), UnorderedElementsAre("one", "u", "k", "frozen", "speed"));
    EXPECT_THAT(names(":paint k"), Contains("k"));
    EXPECT_THAT(names(":paint u = di"), Contains("disc"));
    EXPECT_THAT(names(":show u"), Contains("disc"));
}

TEST_F(PromptNames, FilesAreLookedUp) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "prompt_names";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "spots.cascade") << "x";
    EXPECT_THAT(names(":load " + folder.string() + "/sp"), ElementsAre("spots.cascade"));
    EXPECT_THAT(names(":load " + folder.string() + "/none/"), ElementsAre());
    EXPECT_THAT(names(":load "), Not(Contains("disc")));
}

}  // namespace
}  // namespace cascade
