// The numbers that a pixel of a picture consists of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade {

enum class PictureChannel : std::uint8_t { lightness, red, green, blue, alpha };

/// The names of the channels in scripts, indexed by PictureChannel.
inline constexpr std::array<std::string_view, 5> picture_channel_names{"lightness", "red", "green",
                                                                       "blue", "alpha"};

inline std::string_view name_of(PictureChannel channel) {
    return picture_channel_names[static_cast<std::size_t>(channel)];
}

inline std::optional<PictureChannel> picture_channel_named(std::string_view name) {
    for (std::size_t k = 0; k < picture_channel_names.size(); ++k) {
        if (picture_channel_names[k] == name) return static_cast<PictureChannel>(k);
    }
    return std::nullopt;
}

}  // namespace cascade
