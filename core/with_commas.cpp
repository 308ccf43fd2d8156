// Commas between groups of three digits, counted from the right.
#include "core/with_commas.h"

#include <fmt/format.h>

namespace cascade {

std::string with_commas(std::int64_t number) {
    std::string digits = fmt::format("{}", number);
    const std::size_t first = digits[0] == '-' ? 1 : 0;
    for (std::size_t k = digits.size(); k > first + 3;) {
        k -= 3;
        digits.insert(k, 1, ',');
    }
    return digits;
}

}  // namespace cascade
