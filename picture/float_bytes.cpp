#include "picture/float_bytes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace cascade {

static_assert(std::endian::native == std::endian::little);

void append_floats(std::string& bytes, const Field& field) {
    constexpr std::uint32_t one_nan = 0x7fc00000;
    const PlaneLayout& layout = field.layout();
    for (std::int64_t number = 0; number < layout.row_count(); ++number) {
        const float* row = field.row(number);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const float value = row[i];
            const auto bits = std::isnan(value) ? one_nan : std::bit_cast<std::uint32_t>(value);
            const auto element = std::bit_cast<std::array<char, 4>>(bits);
            bytes.append(element.data(), element.size());
        }
    }
}

}  // namespace cascade
