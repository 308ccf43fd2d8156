// Texts compressed by lz-string, as in links of web pages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cascade::importing {

/// Decodes the text that `compressToEncodedURIComponent` of lz-string (P. Ivanov, "lz-string",
/// 2013) has encoded as letters A … Z, a … z, 0 … 9, +, - and $. lz-string's texts are sequences of
/// 16-bit units, which are converted to UTF-8 here. Empty if the letters are wrong or end too
/// early, or if the text has more than `most` units.
std::optional<std::string> from_lz_string(std::string_view letters, std::size_t most);

}  // namespace cascade::importing
