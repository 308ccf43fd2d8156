// Follows W3C, "Portable Network Graphics (PNG) Specification (Second Edition)", 2003.
#include "picture/png_chunks.h"

#include "core/check.h"
#include "picture/deflate.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {
namespace {

constexpr std::size_t longest_plain_text = 1024;  // Longer texts are stored compressed.

std::string text_chunk(const std::string& keyword, const std::string& text, int level) {
    const bool is_long = text.size() > longest_plain_text;
    std::string data = keyword;
    data.append({'\0', is_long ? '\1' : '\0', '\0'});
    data.append(2, '\0');  // There is no language and no translated keyword.
    return data + (is_long ? deflated(text, level) : text);
}

bool valid_keyword(const std::string& keyword) {
    if (keyword.empty() || keyword.size() > 79) return false;
    if (keyword.front() == ' ' || keyword.back() == ' ') return false;
    if (keyword.find("  ") != std::string::npos) return false;
    return std::all_of(keyword.begin(), keyword.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

void append_big_endian(std::string& bytes, std::size_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void append_chunk(std::string& file, std::string_view name, std::string_view data) {
    append_big_endian(file, data.size());
    const std::size_t begin = file.size();
    file.append(name).append(data);
    append_big_endian(file, crc32_of(std::string_view(file).substr(begin)));
}

Result<void> check_texts(const PngTexts& texts) {
    std::size_t size = 0;
    for (const auto& [keyword, text] : texts) {
        CHECK(valid_keyword(keyword), "the keywords of our PNG texts are plain words");
        size += text.size();
        if (size > longest_png_text) {
            return failure(
                fmt::format("the texts that go with the picture are longer than {} bytes "
                            "with '{}'",
                            longest_png_text, keyword));
        }
        if (text.find('\0') != std::string::npos) {
            return failure(
                fmt::format("the text '{}' that goes with the picture has a NUL byte", keyword));
        }
    }
    return {};
}

void append_srgb_chunk(std::string& file) {
    append_chunk(file, "sRGB", {"\0", 1});  // The rendering intent is perceptual.
}

void append_texts(std::string& file, const PngTexts& texts, int level) {
    for (const auto& [keyword, text] : texts) {
        append_chunk(file, "iTXt", text_chunk(keyword, text, level));
    }
}

}  // namespace cascade
