// Texts inside XML files.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A text as it stands in an attribute: & < > " are written as entities.
std::string xml_escaped(std::string_view text);

}  // namespace cascade
