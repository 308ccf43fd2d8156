// Makes text from files safe for a terminal and for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cascade {

/// The text as one line that is safe on a terminal. U+FFFD replaces control characters (including
/// line ends and tabs), invisible characters that change the text around them, and bytes that are
/// not UTF-8.
std::string printable(std::string_view text);

/// printable() for a text of several lines: line ends and tabs remain.
std::string printable_lines(std::string_view text);

/// A name for a message, shortened by "…" in the middle if longer than `most` characters.
/// Unprintable characters remain.
std::string short_name(std::string_view name, std::size_t most = 160);

}  // namespace cascade
