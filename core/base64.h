// Bytes as text, for protocols that carry text only.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// The bytes of such a text; nothing if it is none.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace cascade
