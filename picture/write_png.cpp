// Writes PNG files: the header, the texts, and the rows.
#include "core/check.h"
#include "core/enough_memory.h"
#include "core/write_encoded.h"
#include "picture/deflate.h"
#include "picture/image.h"
#include "picture/png_chunks.h"
#include "picture/png_rows.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

namespace cascade {
namespace {

constexpr std::int64_t longest_side = 0x7fffffff;  // The limit of the format.

/// The size of a picture in pixels.
struct PngSize {
    std::int64_t width, height;
};

std::string header_of(PngSize size, const PngFormat& format) {
    std::string header;
    append_big_endian(header, static_cast<std::size_t>(size.width));
    append_big_endian(header, static_cast<std::size_t>(size.height));
    header += static_cast<char>(format.depth);
    header += static_cast<char>((format.is_grey ? 0 : 2) | (format.has_alpha ? 4 : 0));
    // The file has the standard compression and filters, and is not interlaced.
    return header.append(3, '\0');
}

std::string compressed_rows(std::vector<std::uint8_t> rows, int level) {
    return deflated({reinterpret_cast<const char*>(rows.data()), rows.size()}, level);
}

/// Encodes a file with the rows that `make_rows` returns.
Result<std::string> encode_rows(PngSize size, const PngTexts& texts, PngMeaning meaning,
                                PngEffort effort, const std::function<PngRows()>& make_rows) {
    if (size.width < 1 || size.height < 1) return failure("the picture has no pixels");
    if (size.width > longest_side || size.height > longest_side) {
        return failure(fmt::format("a picture of {} × {} pixels is too large for a PNG file",
                                   size.width, size.height),
                       fmt::format("a side has at most {} pixels", longest_side));
    }
    if (auto checked = check_texts(texts); !checked) return tl::unexpected(checked.error());
    return enough_memory_for([&]() -> Result<std::string> {
        const int level = effort == PngEffort::fast ? 1 : 6;
        PngRows rows = make_rows();
        std::string file(png_signature);
        append_chunk(file, "IHDR", header_of(size, rows.format));
        if (meaning == PngMeaning::colours) append_srgb_chunk(file);
        append_texts(file, texts, level);
        const std::string data = compressed_rows(std::move(rows.bytes), level);
        for (std::size_t at = 0; at < data.size(); at += longest_png_data) {
            append_chunk(file, "IDAT", std::string_view(data).substr(at, longest_png_data));
        }
        append_chunk(file, "IEND", {});
        return file;
    });
}

}  // namespace

Result<std::string> encode_png(const Image& image, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning, PngEffort effort) {
    return encode_rows({image.width, image.height}, texts, meaning, effort, [&] {
        CHECK(static_cast<std::int64_t>(image.pixels.size()) == image.width * image.height,
              "an image has a colour for each pixel");
        return png_rows(image, depth);
    });
}

Result<std::string> encode_png(const Painting& painting, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning, PngEffort effort) {
    const PlaneLayout& layout = painting.field.layout();
    return encode_rows({layout.width, layout.height}, texts, meaning, effort,
                       [&] { return png_rows(painting, depth); });
}

Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts) {
    return write_encoded(path, [&] { return encode_png(image, depth, texts); });
}

}  // namespace cascade
