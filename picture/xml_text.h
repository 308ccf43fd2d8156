// Texts in XML files.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// Replaces & < > " by entities, for use in an attribute.
std::string xml_escaped(std::string_view text);

}  // namespace cascade
