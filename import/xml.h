// XML from untrusted files: read by pugixml, without document types and entities.
#pragma once

#include "import/importer.h"

#include <pugixml.hpp>

#include <optional>
#include <string>

namespace cascade::importing {

/// Reads the XML of the import's source. If `end` is given, only the bytes before it are read, and
/// the element <VTKFile> ends there. Refuses document types, entities, and elements nested more
/// than 100 deep.
bool read_xml(Import& import, std::size_t end, pugi::xml_document& document);

/// The position of an element, for messages.
Span place_of(const Import& import, const pugi::xml_node& node);
/// The text of an element, as a span of the source. References such as &lt; are not replaced.
Span text_of(const Import& import, const pugi::xml_node& node);
/// An attribute or text in which &lt;, &gt;, &amp;, &quot;, &apos; and numeric references are
/// replaced by the characters that they mean.
std::string unescaped(std::string_view text);

/// A number in an attribute. Reports an error if the attribute is missing or contains no number.
std::optional<double> number_attribute(Import& import, const pugi::xml_node& node,
                                       const char* attribute);
/// A number in a text. Empty if the text is not a number.
std::optional<double> plain_number(std::string_view text);

}  // namespace cascade::importing
