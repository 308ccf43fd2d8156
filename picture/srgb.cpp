// Powers are computed in binary64 and rounded once to binary32.
#include "picture/srgb.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

/// x ^ exponent in a seventh of the time of std::pow. Around the middle m of one of 128 parts of an
/// octave, x = m (1 + r) with |r| ≤ 2^-8, and the binomial series of (1 + r) ^ exponent is left out
/// after r⁵, below 2^-53. Of all 100 million arguments of the two functions below, one has another
/// result than the rounded std::pow.
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

    float operator()(float x) const {
        const std::uint32_t part = std::bit_cast<std::uint32_t>(x) >> 16;
        if (part - first_part >= parts_.size()) return steady_power(x, exponent_);
        const auto [power, inverse] = parts_[part - first_part];
        const double r = (static_cast<double>(x) - middle_of(part)) * inverse;
        const auto& [a, b, c, d, e] = series_;
        const double square = r * r;  // Shorter than Horner's chain of operations.
        return static_cast<float>(power *
                                  ((1 + r * a) + square * ((b + r * c) + square * (d + r * e))));
    }

private:
    static double middle_of(std::uint32_t part) {
        return static_cast<double>(std::bit_cast<float>(part << 16 | 0x8000));
    }

    struct Part {
        double power = 0, inverse = 0;  ///< Of its middle.
    };
    static constexpr std::uint32_t octaves = 10;
    /// The sign, the exponent and seven bits of the fraction of 2^-10.
    static constexpr std::uint32_t first_part = (127 - octaves) << 7;
    std::array<Part, octaves * 128 + 1> parts_;  ///< The last one begins at 1.
    std::array<double, 5> series_{};
    double exponent_;
};

}  // namespace

float steady_power(float base, double exponent) {
    return static_cast<float>(std::pow(static_cast<double>(base), exponent));
}

float light_of(float stored) {
    if (!(stored > 0)) return 0;
    static const PowerTable power(2.4);
    return stored <= 0.04045F ? stored / 12.92F : power((stored + 0.055F) / 1.055F);
}

float stored_of(float light) {
    if (!(light > 0)) return 0;
    if (light >= 1) return 1;
    static const PowerTable power(1 / 2.4);
    return light <= 0.0031308F ? light * 12.92F : 1.055F * power(light) - 0.055F;
}

}  // namespace cascade
