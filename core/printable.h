// Text from files, made safe for a terminal and for a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cascade {

/// The text as one line that is safe on a terminal: control characters (with line ends and tabs),
/// invisible ones that change the text around them, and bytes that are not UTF-8 become U+FFFD.
std::string printable(std::string_view text);

/// The same for a text of several lines: keeps line ends and tabs.
std::string printable_lines(std::string_view text);

/// A name for a message; if longer than `most` characters, shortened by "…" in the middle. Not
/// cleaned.
std::string short_name(std::string_view name, std::size_t most = 160);

}  // namespace cascade
