// Highlights of surfaces by roughness and metalness.
#include "render/gloss.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(Gloss, SmoothSurfacesHaveSmallBrightHighlights) {
    Gloss last = gloss_of(1, 0);
    EXPECT_GE(last.power, 0);
    for (const float roughness : {0.8F, 0.6F, 0.4F, 0.2F, 0.0F}) {
        const Gloss gloss = gloss_of(roughness, 0);
        EXPECT_GT(gloss.power, last.power) << roughness;
        EXPECT_GT(gloss.strength, last.strength) << roughness;
        last = gloss;
    }
    EXPECT_LT(last.power, 600);  // The sun is not a point.
}

// The total light of a lobe, strength / (power + 2), hardly depends on its width.
TEST(Gloss, RoughnessSpreadsTheSameLight) {
    const auto light = [](float roughness) {
        const Gloss gloss = gloss_of(roughness, 0);
        return gloss.strength / (gloss.power + 2);
    };
    for (const float roughness : {0.1F, 0.3F, 0.5F}) {
        EXPECT_NEAR(light(roughness), light(0.2F), 0.4F * light(0.2F)) << roughness;
    }
}

TEST(Gloss, MetalsReflectTwentyFiveTimesAsMuch) {
    EXPECT_NEAR(gloss_of(0.4F, 1).strength / gloss_of(0.4F, 0).strength, 25, 1e-3);
    EXPECT_EQ(gloss_of(0.4F, 1).metalness, 1);
}

}  // namespace
}  // namespace cascade
