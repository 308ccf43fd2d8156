// Replaces bytes that are not UTF-8 and unprintable characters by U+FFFD.
#include "core/printable.h"

#include "core/utf8.h"

namespace cascade {

namespace {

std::string cleaned(std::string_view text, std::string_view kept) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        const bool good = kept.find(text[offset]) != std::string_view::npos ||
                          (point.valid && !is_unprintable(point.value));
        result += good ? text.substr(offset, point.size) : replacement_character;
        offset += point.size;
    }
    return result;
}

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

}  // namespace

std::string printable(std::string_view text) { return cleaned(text, ""); }

std::string printable_lines(std::string_view text) { return cleaned(text, "\n\t"); }

std::string short_name(std::string_view name, std::size_t most) {
    if (count_code_points(name) <= most) return std::string(name);
    std::size_t begin = 0, end = name.size();
    for (std::size_t kept = 1; kept < most / 2; ++kept) begin += decode_utf8(name, begin).size;
    for (std::size_t kept = 0; kept < most / 2 && end > begin; ++kept) {
        do {
            --end;
        } while (end > begin && continues_character(name[end]));
    }
    return std::string(name.substr(0, begin)) + "…" + std::string(name.substr(end));
}

}  // namespace cascade
