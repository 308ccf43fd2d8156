// Pixels of PNG files as numbers.
#include "core/file.h"
#include "picture/grey_picture.h"
#include "picture/png_reader.h"

#include <fmt/format.h>

#include <new>

namespace cascade {
namespace {

// Deflate makes at most 1032 bytes of one: a small file that promises more is damaged.
constexpr std::uint64_t largest_growth = 1100;

struct Format {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::size_t row_bytes = 0;
    int channels = 0;  ///< Grey, grey and alpha, colour, colour and alpha.
    int depth = 0;     ///< 8 or 16 bits a channel.
    int passes = 1;    ///< More than one where the picture is interlaced.
};

/// Reads the header and asks for whole channels of 8 or 16 bits.
bool read_format(PngReader& reader, Format& format) {
    return reader.open() && reader.guarded([&] {
        png_structp png = reader.png();
        png_infop info = reader.info();
        png_read_info(png, info);
        png_set_expand(png);  // Palettes to colours, few bits to 8, a transparent colour to alpha.
        format.passes = png_set_interlace_handling(png);
        png_read_update_info(png, info);
        format.width = png_get_image_width(png, info);
        format.height = png_get_image_height(png, info);
        format.row_bytes = png_get_rowbytes(png, info);
        format.channels = png_get_channels(png, info);
        format.depth = png_get_bit_depth(png, info);
    });
}

/// One channel of a pixel, 0 … 1. Words of 16 bits are stored with the upper byte first.
float level(const png_byte* row, std::size_t channel, int depth) {
    if (depth == 8) return static_cast<float>(row[channel]) / 255.0F;
    const unsigned word = row[2 * channel] * 256U + row[2 * channel + 1];
    return static_cast<float>(word) / 65535.0F;
}

float lightness(const png_byte* row, std::size_t pixel, const Format& format) {
    const auto channels = static_cast<std::size_t>(format.channels);
    const auto channel = [&](std::size_t k) { return level(row, pixel * channels + k, format.depth); };
    const float grey = channels < 3
                           ? channel(0)
                           : 0.2126F * channel(0) + 0.7152F * channel(1) + 0.0722F * channel(2);
    if (channels % 2 == 1) return grey;
    const float alpha = channel(channels - 1);
    return grey * alpha + (1.0F - alpha);
}

/// Reads all rows; of an interlaced picture the passes fill each other's gaps. The end of the file
/// is read too, so that one that is cut off after the pixels is known.
bool read_rows(PngReader& reader, const Format& format, std::vector<png_byte>& bytes) {
    return reader.guarded([&] {
        for (int pass = 0; pass < format.passes; ++pass) {
            for (std::int64_t j = 0; j < format.height; ++j) {
                png_read_row(reader.png(),
                             bytes.data() + static_cast<std::size_t>(j) * format.row_bytes, nullptr);
            }
        }
        png_read_end(reader.png(), nullptr);
    });
}

Failure damaged(const PngReader& reader) {
    return {fmt::format("the PNG file is cut off or damaged: {}", reader.error()), ""};
}

Result<GreyPicture> parse(std::string_view bytes) {
    PngReader reader(bytes);
    Format format;
    if (!read_format(reader, format)) return tl::unexpected<Failure>(damaged(reader));
    if (format.width > most_pixels / format.height) {
        return failure(fmt::format("it has {} × {} pixels, and at most {} are read", format.width,
                                   format.height, most_pixels),
                       "make the picture smaller");
    }
    const std::uint64_t size = format.row_bytes * static_cast<std::uint64_t>(format.height);
    if (size / largest_growth > bytes.size()) {
        return failure("the PNG file is cut off or damaged: it is too short for its pixels");
    }
    std::vector<png_byte> rows(size);
    if (!read_rows(reader, format, rows)) return tl::unexpected<Failure>(damaged(reader));
    GreyPicture picture{format.width, format.height, {}};
    picture.values.reserve(static_cast<std::size_t>(format.width * format.height));
    for (std::int64_t j = 0; j < format.height; ++j) {
        const png_byte* row = rows.data() + static_cast<std::size_t>(j) * format.row_bytes;
        for (std::int64_t i = 0; i < format.width; ++i) {
            picture.values.push_back(lightness(row, static_cast<std::size_t>(i), format));
        }
    }
    return picture;
}

}  // namespace

Result<GreyPicture> parse_grey_picture(std::string_view bytes) {
    if (!has_png_signature(bytes)) return failure("it is not a PNG file");
    try {
        return parse(bytes);
    } catch (const std::bad_alloc&) {
        return failure("there is not enough memory");
    }
}

Result<GreyPicture> read_grey_picture(const std::filesystem::path& path) {
    const Result<std::string> bytes = read_linked_file(path, largest_picture_file);
    if (!bytes) return tl::unexpected<Failure>(bytes.error());
    Result<GreyPicture> picture = parse_grey_picture(*bytes);
    if (!picture) {
        return failure(fmt::format("cannot read '{}': {}", path.string(), picture.error().message),
                       picture.error().hint);
    }
    return picture;
}

}  // namespace cascade
