// Powers are computed in binary64 and rounded once to binary32.
#include "picture/srgb.h"

#include "core/wide_vectors.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

/// Computes x ^ exponent in a seventh of the time of std::pow. Each octave is divided into 128
/// parts. Around the middle m of a part, x = m (1 + r) with |r| ≤ 2^-8. The binomial series of (1 +
/// r) ^ exponent ends after r⁵, because the rest is below 2^-53. Among the 100 million arguments
/// that light_of() and stored_of() may have, only one gives a result that differs from the rounded
/// std::pow.
class PowerTable {
public:
    explicit PowerTable(double exponent) : exponent_(exponent) {
        double factor = 1;
        for (std::size_t k = 0; k < series_.size(); ++k) {
            factor *= (exponent - static_cast<double>(k)) / static_cast<double>(k + 1);
            series_[k] = factor;
        }
        for (std::uint32_t k = 0; k < parts_.size(); ++k) {
            const double middle = middle_of(first_part + k);
            parts_[k] = {std::pow(middle, exponent), 1 / middle};
        }
    }

    bool holds(float x) const { return part_of(x) - first_part < parts_.size(); }

    float operator()(float x) const { return holds(x) ? look_up(x) : steady_power(x, exponent_); }

    /// The power of a number that the table covers.
    float look_up(float x) const {
        const std::uint32_t part = part_of(x);
        const auto& [power, inverse] = parts_[part - first_part];
        const double r = (static_cast<double>(x) - middle_of(part)) * inverse;
        const auto& [a, b, c, d, e] = series_;
        // This chain of operations is shorter than in Horner's scheme.
        const double square = r * r;
        return static_cast<float>(power *
                                  ((1 + r * a) + square * ((b + r * c) + square * (d + r * e))));
    }

private:
    static std::uint32_t part_of(float x) { return std::bit_cast<std::uint32_t>(x) >> 16; }
    static double middle_of(std::uint32_t part) {
        return static_cast<double>(std::bit_cast<float>(part << 16 | 0x8000));
    }

    struct Part {
        double power = 0, inverse = 0;  ///< x ^ exponent and 1 / x at the middle of the part.
    };
    static constexpr std::uint32_t octaves = 10;
    /// The number of the first part, which is part_of(2^-10). A part's number consists of the sign,
    /// the exponent and the seven highest bits of the fraction.
    static constexpr std::uint32_t first_part = (127 - octaves) << 7;
    std::array<Part, octaves * 128 + 1> parts_;  ///< The last part begins at 1.
    std::array<double, 5> series_{};
    double exponent_;
};

/// For values of at most these numbers, light is proportional to the stored value.
constexpr float dark_stored = 0.04045F, dark_light = 0.0031308F;

/// The base b for which the light of a stored value above dark_stored is b ^ 2.4.
float bright_part(float stored) { return (stored + 0.055F) / 1.055F; }

const PowerTable& light_power() {
    static const PowerTable power(2.4);
    return power;
}

const PowerTable& stored_power() {
    static const PowerTable power(1 / 2.4);
    return power;
}

WITH_WIDE_VECTORS bool are_amounts(const float* numbers, std::size_t count) {
    int is_one_outside = 0;
    for (std::size_t k = 0; k < count; ++k) {
        is_one_outside |= static_cast<int>(!(numbers[k] >= 0 && numbers[k] <= 1));
    }
    return is_one_outside == 0;
}

/// Applies light_of() to each number, which must be in 0 … 1.
WITH_WIDE_VECTORS void find_lights(const PowerTable& power, float* __restrict numbers,
                                   std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const float stored = numbers[k];
        const bool is_dark = stored <= dark_stored;
        const float bright = power.look_up(bright_part(is_dark ? 1.0F : stored));
        numbers[k] = is_dark ? stored / 12.92F : bright;
    }
}

/// Applies stored_of() to each number, which must be in 0 … 1.
WITH_WIDE_VECTORS void find_stored(const PowerTable& power, float* __restrict numbers,
                                   std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const float light = numbers[k];
        const bool is_dark = light <= dark_light;
        const float bright = 1.055F * power.look_up(is_dark ? 1.0F : light) - 0.055F;
        numbers[k] = is_dark ? light * 12.92F : light >= 1 ? 1.0F : bright;
    }
}

/// Converts all colours at once with `find_all` if all channels are in 0 … 1. Otherwise converts
/// them one by one with `find_one`.
void convert(std::span<Colour> colours, const PowerTable& power, decltype(find_lights)& find_all,
             Colour (&find_one)(const Colour&)) {
    if (colours.empty()) return;
    float* const numbers = colours.data()->data();
    if (are_amounts(numbers, 3 * colours.size())) {
        find_all(power, numbers, 3 * colours.size());
    } else {
        for (Colour& colour : colours) colour = find_one(colour);
    }
}

}  // namespace

float steady_power(float base, double exponent) {
    return static_cast<float>(std::pow(static_cast<double>(base), exponent));
}

float light_of(float stored) {
    if (!(stored > 0)) return 0;
    return stored <= dark_stored ? stored / 12.92F : light_power()(bright_part(stored));
}

float stored_of(float light) {
    if (!(light > 0)) return 0;
    if (light >= 1) return 1;
    return light <= dark_light ? light * 12.92F : 1.055F * stored_power()(light) - 0.055F;
}

void convert_to_light(std::span<Colour> colours) {
    convert(colours, light_power(), find_lights, light_of);
}

void convert_to_stored(std::span<Colour> colours) {
    convert(colours, stored_power(), find_stored, stored_of);
}

}  // namespace cascade
