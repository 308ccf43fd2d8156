// Prepares texts for XML files.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// Replaces & < > " with entities, for use in an attribute.
std::string xml_escaped(std::string_view text);

}  // namespace cascade
