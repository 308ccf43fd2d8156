// Bytes as text, for protocols that carry text only.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace cascade
