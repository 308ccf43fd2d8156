// The checker makes the right programs of correct settings for models as domains.
// tests/scripts/domain tests wrong settings.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;

TEST(CheckModel, EqualValuesAreOneAndPrintedAsWritten) {
    const auto checked = check_text(
        "domain { surface: sphere }\nsystem_name: turing_spots\nka: distance(0, 1, 1/2)\n"
        "beta: distance(0, 1, 0.5) + keys(0, 0, 0, 1)\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const SurfaceValueId second(1);
    EXPECT_EQ(checked->program->literals->id_of({Function::keys, {0, 0, 0, 1}}), second);
    const std::string text = print_program(*checked->program);
    EXPECT_NE(text.find("ka: distance(0, 1, 0.5)"), std::string::npos) << text;
    EXPECT_NE(text.find("distance(0, 1, 0.5) + keys(0, 0, 0, 1)"), std::string::npos) << text;
}

TEST(CheckModel, DirectionsAndTheirNumbers) {
    const auto checked = check_text(
        "domain { surface: creature; directions: keys(0, 1, 0, 0, 0, 1, 0.3); stretch: 3/2 }\n"
        "system_name: turing_spots\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const ModelSettings& model = *checked->program->domain.model;
    ASSERT_TRUE(model.directions);
    EXPECT_EQ(model.directions->kind, DirectionSettings::Kind::keys);
    EXPECT_THAT(model.directions->numbers, ElementsAre(0, 1, 0, 0, 0, 1));
    EXPECT_EQ(model.directions->smoothing, 0.3);
    EXPECT_EQ(model.stretch, 1.5);
}

TEST(CheckModel, HowAModelStands) {
    const auto stance = [](const std::string& stands) {
        const auto checked =
            check_text("domain { surface: box; " + stands + " }\nsystem_name: turing_spots\n");
        EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        return checked->program ? checked->program->domain.model->stance : Stance();
    };
    for (const Axis up : {Axis::x, Axis::y, Axis::z}) {
        EXPECT_EQ(stance("up: " + std::string(name_of(up))), usual_stance(up));
    }
    EXPECT_EQ(stance("facing: -x"), (Stance{Axis::y, {Axis::x, true}}));
    EXPECT_EQ(stance("facing: y; up: z"), (Stance{Axis::z, {Axis::y, false}}));
}

}  // namespace
}  // namespace cascade::test
