// Encodes bytes as text, for protocols that carry text only.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// Base64 by RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// Decodes a Base64 text. Returns nullopt if `text` is not Base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace cascade
