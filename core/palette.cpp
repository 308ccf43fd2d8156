// The palettes by name, and interpolation between their colours.
#include "core/palette.h"

#include "core/palette_stops.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {
namespace {

namespace stops = palette_stops;

constexpr std::array<Palette, 15> all_palettes{{
    {"grey", "black to white", stops::grey},
    {"viridis", "perceptual: violet, green, yellow", stops::viridis},
    {"magma", "perceptual: black, purple, cream", stops::magma},
    {"inferno", "perceptual: black, red, pale yellow", stops::inferno},
    {"plasma", "perceptual: blue, pink, yellow", stops::plasma},
    {"cividis", "perceptual, alike for colour-blind eyes: blue, grey, yellow", stops::cividis},
    {"leopard", "coat: black-brown rings, tawny within, on gold", stops::leopard},
    {"cheetah", "coat: black spots on pale sand", stops::cheetah},
    {"tan", "coat: brown to cream", stops::tan},
    {"zebra", "coat: black and ivory with a narrow edge", stops::zebra},
    {"giraffe", "coat: chestnut patches with cream between them", stops::giraffe},
    {"coral", "coat: wine red, coral, shell", stops::coral},
    {"lionfish", "coat: maroon stripes on ivory", stops::lionfish},
    {"angelfish", "coat: midnight blue, teal, yellow", stops::angelfish},
    {"dart_frog", "coat: black, cobalt, sky", stops::dart_frog},
}};

}  // namespace

std::span<const Palette> palettes() { return all_palettes; }

std::optional<Colour> find_colour(std::string_view word) {
    if ((word.size() != 4 && word.size() != 7) || word[0] != '#') return std::nullopt;
    const std::size_t digits = word.size() / 3;  // Digits per channel.
    Colour colour{};
    for (std::size_t channel = 0; channel < colour.size(); ++channel) {
        unsigned value = 0;
        const char* const begin = word.data() + 1 + channel * digits;
        const auto [end, error] = std::from_chars(begin, begin + digits, value, 16);
        if (error != std::errc() || end != begin + digits) return std::nullopt;
        colour[channel] = static_cast<float>(value) / (digits == 1 ? 15.0F : 255.0F);
    }
    return colour;
}

std::string hexadecimal(const Colour& colour) {
    const auto part = [](float value) {
        return static_cast<int>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", part(colour[0]), part(colour[1]), part(colour[2]));
}

namespace {

constexpr std::size_t most_stops = 64;

/// A palette given by its colours. Its name and stops are stored here, because `palette` only
/// refers to them.
struct OwnPalette {
    std::string name;
    std::vector<Colour> stops;
    Palette palette;
    const OwnPalette* next = nullptr;
};

/// Finds or adds a palette given by its colours. Returns null if `name` gives none. Palettes are
/// never removed, like literals in scripts. Any thread may call this function.
const Palette* find_own(std::string_view name) {
    static std::atomic<const OwnPalette*> newest = nullptr;
    for (const OwnPalette* each = newest; each != nullptr; each = each->next) {
        if (each->name == name) return &each->palette;
    }
    auto made = std::make_unique<OwnPalette>();
    made->name = std::string(name);
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t end = std::min(name.find(' ', at), name.size());
        if (end > at) {
            const auto colour = find_colour(name.substr(at, end - at));
            if (!colour || made->stops.size() == most_stops) return nullptr;
            made->stops.push_back(*colour);
        }
        at = end + 1;
    }
    if (made->stops.size() < 2) return nullptr;
    made->palette = {made->name, "your own colours", made->stops};
    made->next = newest;
    while (!newest.compare_exchange_weak(made->next, made.get())) {
    }
    return &made.release()->palette;
}

}  // namespace

const Palette* find_palette(std::string_view name) {
    if (name == "gray") name = "grey";
    for (const Palette& palette : all_palettes) {
        if (palette.name == name) return &palette;
    }
    return name.starts_with('#') ? find_own(name) : nullptr;
}

Colour colour_at(const Palette& palette, double position) {
    if (std::isnan(position)) return colour_of_nan;
    const std::size_t last = palette.stops.size() - 1;
    const double place = std::clamp(position, 0.0, 1.0) * static_cast<double>(last);
    const std::size_t left = std::min(static_cast<std::size_t>(place), last - 1);
    const double part = place - static_cast<double>(left);
    Colour colour{};
    for (std::size_t channel = 0; channel < colour.size(); ++channel) {
        const double from = static_cast<double>(palette.stops[left][channel]);
        const double to = static_cast<double>(palette.stops[left + 1][channel]);
        colour[channel] = static_cast<float>(from + (to - from) * part);
    }
    return colour;
}

}  // namespace cascade
