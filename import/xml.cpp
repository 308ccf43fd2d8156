// Reads XML without document types and entities, which could make small files large.
#include "import/xml.h"

#include "core/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cascade::importing {

namespace {

constexpr unsigned int parse_options =
    pugi::parse_minimal | pugi::parse_cdata | pugi::parse_doctype | pugi::parse_ws_pcdata_single;

/// The deepest nesting of elements in a text that need not be valid XML.
std::size_t deepest_nesting(std::string_view text) {
    std::size_t depth = 0, deepest = 0;
    for (std::size_t at = text.find('<'); at != std::string_view::npos;
         at = text.find('<', at + 1)) {
        const char next = at + 1 < text.size() ? text[at + 1] : ' ';
        if (next == '/') {
            if (depth > 0) --depth;
            continue;
        }
        if (next == '!' || next == '?') continue;
        const std::size_t end = text.find('>', at);
        if (end == std::string_view::npos) break;
        if (text[end - 1] != '/') deepest = std::max(deepest, ++depth);
    }
    return deepest;
}

void append_code_point(std::string& text, unsigned long code) {
    const auto add = [&](unsigned long byte) { text += static_cast<char>(byte); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xc0 | code >> 6);
        add(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        add(0xe0 | code >> 12);
        add(0x80 | (code >> 6 & 0x3f));
        add(0x80 | (code & 0x3f));
    }
}

}  // namespace

bool read_xml(Import& import, std::size_t end, pugi::xml_document& document) {
    const std::string_view text = import.bytes().substr(0, end);
    const auto place = [&](std::size_t at) {
        const auto offset = static_cast<std::uint32_t>(std::min(at, text.size()));
        return Span{import.source, offset, offset};
    };
    const std::size_t type = text.find("<!DOCTYPE");
    const std::size_t entity = text.find("<!ENTITY");
    if (const std::size_t at = std::min(type, entity); at != std::string_view::npos) {
        import.diagnostics.error(place(at), "document types and entities of XML cannot be read");
        return false;
    }
    if (deepest_nesting(text) > 100) {
        import.diagnostics.error(place(0), "elements are nested more than 100 deep");
        return false;
    }
    std::string closed(text);
    if (end != std::string_view::npos) closed += "</VTKFile>";
    const auto result =
        document.load_buffer(closed.data(), closed.size(), parse_options, pugi::encoding_utf8);
    if (result) return true;
    import.diagnostics.error(
        place(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
        fmt::format("this is not valid XML: {}", result.description()));
    return false;
}

Span place_of(const Import& import, const pugi::xml_node& node) {
    const auto begin = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    const auto size = static_cast<std::uint32_t>(std::string_view(node.name()).size());
    return {import.source, begin, begin + size};
}

Span text_of(const Import& import, const pugi::xml_node& node) {
    const pugi::xml_node child = node.first_child();
    if (!child || (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata)) {
        return {import.source, 0, 0};
    }
    const auto begin =
        static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(child.offset_debug(), 0));
    return {import.source, begin,
            begin + static_cast<std::uint32_t>(std::string_view(child.value()).size())};
}

std::string unescaped(std::string_view text) {
    constexpr std::pair<std::string_view, char> references[] = {
        {"lt;", '<'}, {"gt;", '>'}, {"amp;", '&'}, {"quot;", '"'}, {"apos;", '\''}};
    std::string result;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] != '&') {
            result += text[at];
            continue;
        }
        const std::string_view rest = text.substr(at + 1);
        const std::size_t before = result.size();
        for (const auto& [reference, letter] : references) {
            if (!rest.starts_with(reference)) continue;
            result += letter;
            at += reference.size();
        }
        const std::size_t end = rest.substr(0, 9).find(';');
        if (result.size() == before && rest.starts_with('#') && end != std::string_view::npos) {
            const bool is_hexadecimal = rest.substr(1).starts_with('x');
            const std::string digits(rest.substr(is_hexadecimal ? 2 : 1, end));
            append_code_point(result,
                              std::strtoul(digits.c_str(), nullptr, is_hexadecimal ? 16 : 10));
            at += end + 1;
        } else if (result.size() == before) {
            result += '&';
        }
    }
    return result;
}

std::optional<double> plain_number(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto result = from_decimal(text.data(), text.data() + text.size(), value);
    if (text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size() ||
        !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::optional<double> number_attribute(Import& import, const pugi::xml_node& node,
                                       const char* attribute) {
    const auto value = plain_number(node.attribute(attribute).value());
    if (value) return value;
    import.diagnostics.error(place_of(import, node),
                             fmt::format("<{}> needs a number as its attribute '{}'",
                                         plain_line(node.name()), attribute));
    return std::nullopt;
}

}  // namespace cascade::importing
