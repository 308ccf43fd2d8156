#include "tests/support/random_links.h"

#include "tests/support/random_stream.h"

#include <bit>

namespace cascade::test {

LinkList random_links(std::size_t cells, std::uint64_t seed, int trouble_percent) {
    RandomStream random(seed);
    const auto number = [&]() -> double {
        if (!random.chance(trouble_percent)) return random.symmetric();
        return random.chance(50) ? std::bit_cast<float>(hostile_word(random))
                                 : std::bit_cast<double>(hostile_long_word(random));
    };
    LinkList list;
    bool is_desert = false;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        if (random.chance(5)) is_desert = !is_desert && cells > 1;
        const std::uint32_t many = random.chance(2) ? 70 : random.below(10);
        for (std::uint32_t count = is_desert ? 0 : many; count > 0; --count) {
            list.neighbours.push_back(random.below(cells));
            list.weights.push_back(number());
            const double x = number(), y = number();
            list.gradients.push_back({x, y, number()});
        }
        list.ends.push_back(list.neighbours.size());
    }
    // There must be at least one link.
    if (list.neighbours.empty() && cells > 0) {
        list.neighbours.push_back(0);
        list.weights.push_back(1);
        list.gradients.push_back({1, 1, 1});
        for (std::size_t& end : list.ends) end = 1;
    }
    return list;
}

}  // namespace cascade::test
