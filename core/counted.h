// Counts with their nouns, for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

/// The count, followed by the caller's words for one thing or for many: "1 face was", "1,234 faces
/// were".
std::string counted(std::int64_t count, std::string_view one, std::string_view many);
/// "1 step", "2 passes": the plural ends in -s, or in -es after an s.
std::string counted(std::int64_t count, std::string_view noun);

}  // namespace cascade
