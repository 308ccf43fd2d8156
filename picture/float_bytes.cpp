#include "picture/float_bytes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace cascade {

static_assert(std::endian::native == std::endian::little);

void append_floats(std::string& bytes, const Field& field) {
    field.visit([&](const auto& plane) {
        const PlaneLayout& layout = plane.layout();
        using Number = std::remove_cvref_t<decltype(*plane.row(0))>;
        // 0x7fc00000, or 0x7ff8000000000000.
        constexpr Number one_nan = std::numeric_limits<Number>::quiet_NaN();
        for (std::int64_t number = 0; number < layout.row_count(); ++number) {
            const Number* row = plane.row(number);
            for (std::int64_t i = 0; i < layout.width; ++i) {
                const Number value = std::isnan(row[i]) ? one_nan : row[i];
                const auto element = std::bit_cast<std::array<char, sizeof value>>(value);
                bytes.append(element.data(), element.size());
            }
        }
    });
}

}  // namespace cascade
