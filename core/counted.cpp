// Formats counts with their nouns for messages.
#include "core/counted.h"

#include "core/with_commas.h"

#include <fmt/format.h>

namespace cascade {

std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", with_commas(count), count == 1 ? one : many);
}

std::string counted(std::int64_t count, std::string_view noun) {
    return counted(count, noun, fmt::format("{}{}", noun, noun.ends_with('s') ? "es" : "s"));
}

}  // namespace cascade
