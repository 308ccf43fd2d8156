// Text from files, made fit for a terminal and for a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cascade {

/// The text in one line that a terminal only shows: control characters (line ends and tabs too),
/// invisible characters that change the text around them, and bytes that are no UTF-8 become
/// U+FFFD.
std::string printable(std::string_view text);

/// The same of a text of several lines: line ends and tabs stay.
std::string printable_lines(std::string_view text);

/// A name for a message: where it is longer than `most` characters, its beginning and its end with
/// "…" between them. Not cleaned.
std::string short_name(std::string_view name, std::size_t most = 160);

}  // namespace cascade
