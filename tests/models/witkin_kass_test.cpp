// Witkin and Kass's patterns in numbers: the reacting area, the wavelength and the direction. The
// expected values are from an independent reference program in double precision (three seeds, 192 ×
// 192).
#include "tests/models/model.h"

#include "core/file.h"
#include "measure/features.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

std::string button(const std::string& name) {
    auto text =
        read_file(std::string(CASCADE_SOURCE_DIR) + "/examples/witkin_kass/" + name + ".cascade",
                  1u << 20);
    EXPECT_TRUE(text) << name;
    return text ? *text : "";
}

measure::Features features_of(const Model& model, const std::string& expression) {
    measure::Samples samples;
    const auto side = static_cast<std::size_t>(model.width());
    samples.cells = {side, side, 1};
    samples.values = model.values(expression);
    return measure::measure(samples);
}

/// The wavelength is 2 π s √d across the stripes, and larger for stripes oblique to the grid.
TEST(WitkinKass, Zebra) {
    Model model(button("zebra"));
    model.finish();
    const measure::Features zebra = features_of(model, "plus[1]");
    const double predicted = 2 * std::numbers::pi * std::sqrt(1.5);
    EXPECT_NEAR(zebra.wavelength / predicted, 1.15, 0.15);
    EXPECT_NEAR(zebra.angle, 60, 5);
    EXPECT_GT(zebra.anisotropy, 0.8);
    EXPECT_NEAR(model.mean("plus[1] > minus[1]"), 0.5, 0.04);
    EXPECT_NEAR(model.smallest("plus[1]"), 0.03, 0.03);
    EXPECT_NEAR(model.largest("plus[1]"), 0.97, 0.03);
    EXPECT_NEAR(model.largest("plus[1] - minus[1]"), 0.12, 0.03);
}

/// In the pattern "difference of abs's", as many cells are on as off.
TEST(WitkinKass, MazeIsBalanced) {
    Model model(button("maze"));
    model.finish();
    EXPECT_NEAR(model.mean("abs(max(plus[i] - minus[i] over i)) > "
                           "abs(min(plus[i] - minus[i] over i))"),
                0.5, 0.04);
    EXPECT_LT(features_of(model, "sum(plus[i] over i)").anisotropy, 0.4);
}

TEST(WitkinKass, WeaveGoesBothWays) {
    Model model(button("weave"));
    model.finish();
    EXPECT_NEAR(model.mean("max(plus[i] - minus[i] over i) > 0.02"), 0.47, 0.1);
    const measure::Features along = features_of(model, "plus[1]"),
                            across = features_of(model, "plus[2]");
    EXPECT_LT(std::abs(std::remainder(along.angle, 180)), 15);
    EXPECT_NEAR(across.angle, 90, 15);
}

/// There is one patch at each seed, and about two fifths of all cells react.
TEST(WitkinKass, GiraffeHasAPatchForEachSeed) {
    Model model(button("giraffe"));
    model.finish();
    const measure::Features coat = features_of(model, "plus[1] > minus[1]");
    EXPECT_NEAR(coat.spots, 32, 2);
    EXPECT_NEAR(coat.area, 0.42, 0.04);
    EXPECT_NEAR(model.mean("plus[1] > 0.15"), 0.70, 0.05);
}

TEST(WitkinKass, ReptileHasAScaleForEachSeed) {
    Model model(button("reptile"));
    model.finish();
    const measure::Features skin = features_of(model, "plus[1] > minus[1]");
    EXPECT_NEAR(skin.spots, 98, 4);
    EXPECT_NEAR(skin.area, 0.32, 0.04);
}

TEST(WitkinKass, StuccoIsAnEvenMaze) {
    Model model(button("stucco"));
    model.finish();
    const measure::Features wall = features_of(model, "plus[1]");
    EXPECT_NEAR(wall.wavelength, 14.7, 1.5);
    EXPECT_LT(wall.anisotropy, 0.2);
}

}  // namespace
}  // namespace cascade::models
