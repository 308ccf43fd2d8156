// Minimum cuts, compared with all choices.
#include "lang/lower/minimum_cut.h"

#include "support/random_stream.h"

#include <gtest/gtest.h>

#include <vector>

namespace cascade::test {
namespace {

using lowering::MinimumCut;

struct Network {
    std::vector<std::int64_t> reading, operations;
    std::vector<std::vector<std::uint32_t>> operands;
    std::vector<bool> wanted;

    /// The cost of a choice of parts to keep.
    std::int64_t cost(const std::vector<bool>& kept) const {
        std::vector<bool> needed = wanted;
        std::int64_t sum = 0;
        for (std::size_t part = reading.size(); part-- > 0;) {
            if (!needed[part]) continue;
            sum += kept[part] ? reading[part] : operations[part];
            if (kept[part]) continue;
            for (const std::uint32_t operand : operands[part]) needed[operand] = true;
        }
        return sum;
    }
};

Network random_network(std::uint64_t seed) {
    RandomStream stream(seed);
    Network network;
    const std::uint32_t parts = 1 + stream.below(9);
    for (std::uint32_t part = 0; part < parts; ++part) {
        network.reading.push_back(stream.chance(15) ? MinimumCut::unlimited : 13);
        network.operations.push_back(1 + stream.below(20));
        std::vector<std::uint32_t>& operands = network.operands.emplace_back();
        for (std::uint32_t k = 0; part > 0 && k < stream.below(3); ++k) {
            operands.push_back(stream.below(part));
        }
        network.wanted.push_back(stream.chance(40));
    }
    return network;
}

TEST(MinimumCut, IsTheCheapestOfAllChoices) {
    int kept_some = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Network network = random_network(seed);
        const std::size_t parts = network.reading.size();
        MinimumCut cut;
        for (std::size_t part = 0; part < parts; ++part) {
            EXPECT_EQ(cut.add(network.reading[part], network.operations[part],
                              network.operands[part]),
                      part);
        }
        for (std::uint32_t part = 0; part < parts; ++part) {
            if (network.wanted[part]) cut.want(part);
        }
        std::vector<bool> found(parts);
        for (std::uint32_t part = 0; part < parts; ++part) {
            found[part] = cut.is_kept(part);
            kept_some += found[part] ? 1 : 0;
        }
        std::int64_t best = network.cost(found);
        for (std::size_t choice = 0; choice < std::size_t{1} << parts; ++choice) {
            std::vector<bool> kept(parts);
            for (std::size_t part = 0; part < parts; ++part) kept[part] = (choice >> part & 1) != 0;
            EXPECT_GE(network.cost(kept), best) << "seed " << seed;
        }
    }
    EXPECT_GT(kept_some, 200);
}

}  // namespace
}  // namespace cascade::test
