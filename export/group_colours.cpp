// A list of indices of colours is partitioned again and again. Each group is a range of this list.
#include "export/group_colours.h"

#include <algorithm>
#include <numeric>

namespace cascade {

namespace {

/// A range of the list, with the channel in which the group has its largest range.
struct Group {
    std::size_t begin = 0, end = 0;
    std::size_t channel = 0;
    float low = 0, high = 0;

    float range() const { return high - low; }
};

Group group_of(std::span<const Colour> colours, std::span<const std::uint32_t> numbers,
               std::size_t begin, std::size_t end) {
    Group group{begin, end};
    for (std::size_t c = 0; c < 3; ++c) {
        float low = colours[numbers[begin]][c], high = low;
        for (std::size_t k = begin; k < end; ++k) {
            low = std::min(low, colours[numbers[k]][c]);
            high = std::max(high, colours[numbers[k]][c]);
        }
        if (high - low > group.range()) {
            group.channel = c;
            group.low = low;
            group.high = high;
        }
    }
    return group;
}

}  // namespace

ColourGroups group_colours(std::span<const Colour> colours, std::size_t most) {
    ColourGroups result;
    if (colours.empty()) return result;
    std::vector<std::uint32_t> numbers(colours.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::vector<Group> groups = {group_of(colours, numbers, 0, numbers.size())};
    while (groups.size() < most) {
        Group& widest =
            *std::max_element(groups.begin(), groups.end(),
                              [](const Group& a, const Group& b) { return a.range() < b.range(); });
        if (!(widest.range() > 0)) break;
        const Group whole = widest;
        const float middle = whole.low + whole.range() / 2;
        const auto at =
            std::stable_partition(numbers.begin() + static_cast<std::ptrdiff_t>(whole.begin),
                                  numbers.begin() + static_cast<std::ptrdiff_t>(whole.end),
                                  [&](std::uint32_t number) {
                                      // This condition is never true for all colours of the group.
                                      // Its second half matters if rounding has moved the middle to
                                      // the highest colour.
                                      return colours[number][whole.channel] <= middle &&
                                             colours[number][whole.channel] < whole.high;
                                  });
        const auto cut = static_cast<std::size_t>(at - numbers.begin());
        widest = group_of(colours, numbers, whole.begin, cut);
        groups.push_back(group_of(colours, numbers, cut, whole.end));
    }
    result.group.resize(colours.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        std::array<double, 3> sum{};
        for (std::size_t k = groups[g].begin; k < groups[g].end; ++k) {
            result.group[numbers[k]] = static_cast<std::uint32_t>(g);
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += static_cast<double>(colours[numbers[k]][c]);
        }
        const auto count = static_cast<double>(groups[g].end - groups[g].begin);
        Colour mean;
        for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<float>(sum[c] / count);
        result.means.push_back(mean);
    }
    return result;
}

}  // namespace cascade
