// Adds underscores to names that are already in use. Clamps colours, and replaces a colour with a
// NaN by the colour that represents NaN.
#include "export/channels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

std::vector<std::string> distinct_names(std::span<const Channel> channels,
                                        std::initializer_list<std::string_view> reserved) {
    std::vector<std::string> names;
    const auto is_taken = [&](const std::string& name) {
        return std::find(reserved.begin(), reserved.end(), name) != reserved.end() ||
               std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Channel& channel : channels) {
        std::string name = channel.name;
        while (name.empty() || is_taken(name)) name += '_';
        names.push_back(std::move(name));
    }
    return names;
}

Colour shown(const Colour& colour) {
    const bool is_colour =
        !std::isnan(colour[0]) && !std::isnan(colour[1]) && !std::isnan(colour[2]);
    if (!is_colour) return colour_of_nan;
    return {std::clamp(colour[0], 0.0F, 1.0F), std::clamp(colour[1], 0.0F, 1.0F),
            std::clamp(colour[2], 0.0F, 1.0F)};
}

bool are_single(std::span<const Vector3d> points) {
    const auto is_single = [](double number) {
        const double size = std::abs(number);
        const bool is_normal =
            size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max();
        return number == 0 ||
               (is_normal && static_cast<double>(static_cast<float>(number)) == number);
    };
    return std::all_of(points.begin(), points.end(), [&](Vector3d p) {
        return is_single(p.x) && is_single(p.y) && is_single(p.z);
    });
}

}  // namespace cascade
