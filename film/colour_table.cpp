// Counts how often each colour occurs. Groups are ranges in the list of colours.
#include "film/colour_table.h"

#include "core/check.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace cascade {
namespace {

struct Counted {
    PackedColour colour = 0;
    std::uint32_t count = 0;
};

constexpr std::array channels = {16, 8, 0};
unsigned level(PackedColour colour, std::size_t channel) {
    return colour >> channels[channel] & 0xffU;
}

std::vector<Counted> counted(std::span<const FilmFrame> frames) {
    std::vector<PackedColour> all;
    for (const FilmFrame& frame : frames) {
        const unsigned char* pixel = frame.row(0);
        const unsigned char* const end = pixel + frame.pixels.size();
        for (; pixel != end; pixel += FilmFrame::pixel_bytes) {
            if (!is_hole(pixel)) all.push_back(packed(pixel));
        }
    }
    std::sort(all.begin(), all.end());
    std::vector<Counted> counts;
    for (const PackedColour colour : all) {
        if (counts.empty() || counts.back().colour != colour) counts.push_back({colour, 0});
        ++counts.back().count;
    }
    return counts;
}

/// A range of colours, with their means and variance.
struct Group {
    std::span<Counted> colours;
    std::array<double, 3> means{};
    std::size_t widest = 0;  ///< The channel with the largest variance.
    double spread = 0;       ///< The sum of squared distances from the mean in that channel.

    explicit Group(std::span<Counted> members) : colours(members) {
        double weight = 0;
        std::array<double, 3> sums{}, squares{};
        for (const Counted& one : colours) {
            weight += one.count;
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = level(one.colour, c);
                sums[c] += one.count * value;
                squares[c] += one.count * value * value;
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            means[c] = sums[c] / weight;
            const double here = squares[c] - sums[c] * means[c];
            if (here <= spread) continue;
            spread = here;
            widest = c;
        }
    }

    PackedColour mean() const {
        PackedColour colour = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            colour |= static_cast<PackedColour>(means[c] + 0.5) << channels[c];
        }
        return colour;
    }
};

}  // namespace

std::optional<std::vector<PackedColour>> few_colours(const FilmFrame& frame, std::size_t most) {
    std::unordered_set<PackedColour> found;
    PackedColour last = std::numeric_limits<PackedColour>::max();
    const unsigned char* pixel = frame.row(0);
    const unsigned char* const end = pixel + frame.pixels.size();
    for (; pixel != end; pixel += FilmFrame::pixel_bytes) {
        if (is_hole(pixel) || packed(pixel) == last) continue;
        last = packed(pixel);
        found.insert(last);
        if (found.size() > most) return std::nullopt;
    }
    std::vector<PackedColour> colours(found.begin(), found.end());
    std::sort(colours.begin(), colours.end());
    return colours;
}

std::vector<PackedColour> chosen_colours(std::span<const FilmFrame> frames, std::size_t count) {
    std::vector<Counted> colours = counted(frames);
    std::vector<PackedColour> table;
    if (colours.size() <= count) {
        for (const Counted& one : colours) table.push_back(one.colour);
        return table;
    }
    std::vector<Group> groups = {Group(colours)};
    while (groups.size() < count) {
        const auto widest =
            std::max_element(groups.begin(), groups.end(),
                             [](const Group& a, const Group& b) { return a.spread < b.spread; });
        if (widest->spread <= 0) break;
        const std::span<Counted> all = widest->colours;
        const double middle = widest->means[widest->widest];
        const auto second = std::partition(all.begin(), all.end(), [&](const Counted& one) {
            return level(one.colour, widest->widest) <= middle;
        });
        const auto first_count = static_cast<std::size_t>(second - all.begin());
        *widest = Group(all.first(first_count));
        groups.emplace_back(all.subspan(first_count));
    }
    for (const Group& group : groups) table.push_back(group.mean());
    std::sort(table.begin(), table.end());
    table.erase(std::unique(table.begin(), table.end()), table.end());
    return table;
}

NearestColours::NearestColours(std::vector<PackedColour> table)
    : table_(std::move(table)), known_(std::size_t{1} << 24) {
    CHECK(!table_.empty() && table_.size() <= 256, "colours are numbered by a byte");
}

std::uint8_t NearestColours::operator()(PackedColour colour) {
    std::uint16_t& known = known_[colour];
    if (known == 0) {
        int nearest = std::numeric_limits<int>::max();
        for (std::size_t k = 0; k < table_.size(); ++k) {
            int distance = 0;
            constexpr std::array weights = {2, 4, 3};
            for (std::size_t c = 0; c < 3; ++c) {
                const int off =
                    static_cast<int>(level(colour, c)) - static_cast<int>(level(table_[k], c));
                distance += weights[c] * off * off;
            }
            if (distance >= nearest) continue;
            nearest = distance;
            known = static_cast<std::uint16_t>(1 + k);
        }
    }
    return static_cast<std::uint8_t>(known - 1);
}

}  // namespace cascade
