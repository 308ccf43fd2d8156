// Writes PNG files, chunk by chunk: W3C, "Portable Network Graphics (PNG) Specification (Second
// Edition)", 2003.
#include "core/check.h"
#include "core/enough_memory.h"
#include "core/write_encoded.h"
#include "picture/deflate.h"
#include "picture/image.h"
#include "picture/png_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {
namespace {

constexpr std::int64_t longest_side = 0x7fffffff;           // The format's limit.
constexpr std::size_t longest_plain_text = 1024;            // Longer ones are compressed.
constexpr std::size_t longest_data = std::size_t{1} << 20;  // In one chunk: readers buffer it.

void append_big_endian(std::string& bytes, std::size_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void append_chunk(std::string& file, std::string_view name, std::string_view data) {
    append_big_endian(file, data.size());
    const std::size_t begin = file.size();
    file.append(name).append(data);
    append_big_endian(file, crc32_of(std::string_view(file).substr(begin)));
}

std::string header_of(const Image& image, const PngFormat& format) {
    std::string header;
    append_big_endian(header, static_cast<std::size_t>(image.width));
    append_big_endian(header, static_cast<std::size_t>(image.height));
    header += static_cast<char>(format.depth);
    header += static_cast<char>((format.is_grey ? 0 : 2) | (format.has_alpha ? 4 : 0));
    return header.append(3, '\0');  // The usual compression and filters, not interlaced.
}

std::string text_chunk(const std::string& keyword, const std::string& text, int level) {
    const bool is_long = text.size() > longest_plain_text;
    std::string data = keyword;
    data.append({'\0', is_long ? '\1' : '\0', '\0'});
    data.append(2, '\0');  // No language, no translated keyword.
    return data + (is_long ? deflated(text, level) : text);
}

std::string compressed_rows(const Image& image, const PngFormat& format, int level) {
    const std::vector<std::uint8_t> rows = png_rows(image, format);
    return deflated({reinterpret_cast<const char*>(rows.data()), rows.size()}, level);
}

bool valid_keyword(const std::string& keyword) {
    if (keyword.empty() || keyword.size() > 79) return false;
    if (keyword.front() == ' ' || keyword.back() == ' ') return false;
    if (keyword.find("  ") != std::string::npos) return false;
    return std::all_of(keyword.begin(), keyword.end(), [](char c) { return c >= ' ' && c <= '~'; });
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

}  // namespace

Result<std::string> encode_png(const Image& image, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning, PngEffort effort) {
    if (image.width < 1 || image.height < 1) return failure("the picture has no pixels");
    if (image.width > longest_side || image.height > longest_side) {
        return failure(fmt::format("a picture of {} × {} pixels is too large for a PNG file",
                                   image.width, image.height),
                       fmt::format("a side has at most {} pixels", longest_side));
    }
    CHECK(static_cast<std::int64_t>(image.pixels.size()) == image.width * image.height,
          "an image has a colour for each pixel");
    if (auto checked = check_texts(texts); !checked) {
        return tl::unexpected<Failure>(checked.error());
    }
    return enough_memory_for([&]() -> Result<std::string> {
        const int level = effort == PngEffort::fast ? 1 : 6;
        const PngFormat format = png_format(image, depth);
        std::string file = "\x89PNG\r\n\x1a\n";
        append_chunk(file, "IHDR", header_of(image, format));
        if (meaning == PngMeaning::colours) append_chunk(file, "sRGB", {"\0", 1});  // Perceptual.
        for (const auto& [keyword, text] : texts) {
            append_chunk(file, "iTXt", text_chunk(keyword, text, level));
        }
        const std::string data = compressed_rows(image, format, level);
        for (std::size_t at = 0; at < data.size(); at += longest_data) {
            append_chunk(file, "IDAT", std::string_view(data).substr(at, longest_data));
        }
        append_chunk(file, "IEND", {});
        return file;
    });
}

Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts) {
    return write_encoded(path, [&] { return encode_png(image, depth, texts); });
}

}  // namespace cascade
