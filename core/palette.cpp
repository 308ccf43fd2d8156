// The palettes by name, and interpolation between their colours.
#include "core/palette.h"

#include "core/palette_stops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

const Palette* find_palette(std::string_view name) {
    for (const Palette& palette : all_palettes) {
        if (palette.name == name) return &palette;
    }
    return nullptr;
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
