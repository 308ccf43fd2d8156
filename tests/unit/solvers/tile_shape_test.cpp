// Tiles in time compute each layer of each level exactly once, and only after the layers that it
// needs.
#include "solvers/tile_shape.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace cascade::test {
namespace {

/// When a layer of a level is done. Parts of a phase are done at the same time, and the layers of a
/// part in order.
struct Turn {
    int phase = -1, part = 0;
    std::int64_t order = 0;
};

using Turns = std::vector<std::vector<Turn>>;  ///< Indexed by level and layer.

/// Notes the turns of all layers. Returns the number of layers that were done twice.
int walk(const TileAxis& axis, int levels, Turns& turns) {
    int twice = 0;
    turns.assign(static_cast<std::size_t>(levels),
                 std::vector<Turn>(static_cast<std::size_t>(axis.layers())));
    for (int phase = 0; phase < 2; ++phase) {
        const int parts = phase == 0 ? axis.bands() : axis.borders();
        for (int part = 0; part < parts; ++part) {
            for (int level = 0; level < levels; ++level) {
                const LayerRange range =
                    phase == 0 ? axis.upright(part, level) : axis.inverted(part, level);
                for (std::int64_t layer = range.begin; layer < range.end; ++layer) {
                    Turn& turn = turns[static_cast<std::size_t>(level)]
                                      [static_cast<std::size_t>(axis.wrapped(layer))];
                    twice += turn.phase >= 0 ? 1 : 0;
                    // Layers are ordered by layer + level, and for equal sums by level.
                    turn = {phase, part, (layer + level) * levels + level};
                }
            }
        }
    }
    return twice;
}

bool is_before(const Turn& a, const Turn& b) {
    if (a.phase != b.phase) return a.phase < b.phase;
    return a.part == b.part && a.order < b.order;
}

/// Expects that each layer is done after the layers of lower levels that are at most one layer
/// away. A level reads what lower levels wrote, and overwrites what they read.
void expect_in_order(const TileAxis& axis, bool wraps, int levels) {
    Turns turns;
    ASSERT_EQ(walk(axis, levels, turns), 0);
    const std::int64_t layers = axis.layers();
    for (std::size_t level = 0; level < turns.size(); ++level) {
        for (std::int64_t layer = 0; layer < layers; ++layer) {
            const Turn& turn = turns[level][static_cast<std::size_t>(layer)];
            ASSERT_GE(turn.phase, 0) << "level " << level << ", layer " << layer;
            for (std::int64_t away = -1; away <= 1; ++away) {
                const std::int64_t other = wraps ? (layer + away + layers) % layers : layer + away;
                if (other < 0 || other >= layers) continue;
                for (std::size_t lower = 0; lower < level; ++lower) {
                    ASSERT_TRUE(is_before(turns[lower][static_cast<std::size_t>(other)], turn))
                        << layers << " layers, " << axis.bands() << " bands, wraps " << wraps
                        << ": level " << level << " of layer " << layer << " and level " << lower
                        << " of layer " << other;
                }
            }
        }
    }
}

TEST(TileShape, DoesAllInOrder) {
    for (std::int64_t layers = 1; layers < 48; ++layers) {
        for (int bands = 1; bands <= 5 && bands <= layers; ++bands) {
            for (const bool wraps : {false, true}) {
                const TileAxis axis(layers, bands, wraps);
                const int most = std::min(axis.most_levels(), 24);
                ASSERT_GE(most, 1);
                for (int levels = 1; levels <= most; ++levels) {
                    expect_in_order(axis, wraps, levels);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

TEST(TileShape, ChecksSeeTooManyLevels) {
    // If parts around borders touched, they would do layers twice.
    const TileAxis axis(12, 3, true);
    Turns turns;
    EXPECT_EQ(axis.most_levels(), 3);
    EXPECT_EQ(walk(axis, 3, turns), 0);
    EXPECT_GT(walk(axis, 4, turns), 0);
}

TEST(TileShape, ManyLevelsTakeWideBands) {
    EXPECT_EQ(TileAxis(100, 1, true).most_levels(), 51);
    EXPECT_EQ(TileAxis(100, 4, true).most_levels(), 13);
    EXPECT_EQ(TileAxis(100, 4, false).most_levels(), 13);
    EXPECT_GT(TileAxis(3, 1, false).most_levels(), 1000);
    EXPECT_EQ(TileAxis(1, 1, true).most_levels(), 1);
    EXPECT_EQ(TileAxis(3, 8, true).bands(), 3);
}

}  // namespace
}  // namespace cascade::test
