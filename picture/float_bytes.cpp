// Appends rows one by one, without padding and halo.
#include "picture/float_bytes.h"

#include <cstdint>

namespace cascade {

void append_floats(std::string& bytes, const Field& field) {
    field.visit([&](const auto& plane) {
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t number = 0; number < layout.row_count(); ++number) {
            const auto* row = plane.row(number);
            for (std::int64_t i = 0; i < layout.width; ++i) append_number(bytes, row[i]);
        }
    });
}

}  // namespace cascade
