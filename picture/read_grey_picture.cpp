// Reads the pixels of PNG files as numbers.
#include "core/enough_memory.h"
#include "core/file.h"
#include "picture/grey_picture.h"
#include "picture/png_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cascade {
namespace {

// Deflate expands data at most 1032 times. A small file that declares more pixels is damaged.
constexpr std::uint64_t largest_growth = 1100;
constexpr std::uint64_t many_pixels = std::uint64_t{1} << 24;

struct Format {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::uint64_t packed_bytes = 0;  ///< The size of all rows, before compression.
    std::size_t row_bytes = 0;
    int channels = 0;  ///< 1 for grey, 2 for grey and alpha, 3 for colour, 4 for colour and alpha.
    int depth = 0;     ///< Bits for each channel, 8 or 16.
    int passes = 1;    ///< The number of passes, above 1 if the picture is interlaced.
};

/// Reads the header without allocating even a row. Skips ancillary chunks (texts and profiles),
/// because they may inflate to any size.
bool read_header(PngReader& reader, Format& format) {
    return reader.open() && reader.guarded([&] {
        png_structp png = reader.png();
        png_infop info = reader.info();
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png, info);
        format.width = png_get_image_width(png, info);
        format.height = png_get_image_height(png, info);
        format.packed_bytes =
            png_get_rowbytes(png, info) * static_cast<std::uint64_t>(format.height);
        if (png_get_interlace_type(png, info) != PNG_INTERLACE_NONE) {
            format.passes = PNG_INTERLACE_ADAM7_PASSES;
        }
    });
}

/// Makes libpng convert channels to 8 or 16 bits, and allocate memory for rows.
bool start_rows(PngReader& reader, Format& format) {
    return reader.guarded([&] {
        png_structp png = reader.png();
        png_infop info = reader.info();
        // Palettes become colours, channels of few bits get 8 bits, and a transparent colour
        // becomes alpha.
        png_set_expand(png);
        png_read_update_info(png, info);
        format.row_bytes = png_get_rowbytes(png, info);
        format.channels = png_get_channels(png, info);
        format.depth = png_get_bit_depth(png, info);
    });
}

/// One channel of a pixel, 0 … 1. Channels of 16 bits are big-endian.
float level(const png_byte* row, std::size_t channel, int depth) {
    if (depth == 8) return static_cast<float>(row[channel]) / 255.0F;
    const unsigned word = row[2 * channel] * 256U + row[2 * channel + 1];
    return static_cast<float>(word) / 65535.0F;
}

float number_of(const png_byte* row, std::size_t pixel, const Format& format,
                PictureChannel wanted) {
    const auto channels = static_cast<std::size_t>(format.channels);
    const auto channel = [&](std::size_t k) {
        return level(row, pixel * channels + k, format.depth);
    };
    switch (wanted) {
        case PictureChannel::lightness: break;
        case PictureChannel::red: return channel(0);
        case PictureChannel::green: return channel(channels < 3 ? 0 : 1);
        case PictureChannel::blue: return channel(channels < 3 ? 0 : 2);
        case PictureChannel::alpha: return channels % 2 == 1 ? 1.0F : channel(channels - 1);
    }
    const float grey = channels < 3
                           ? channel(0)
                           : 0.2126F * channel(0) + 0.7152F * channel(1) + 0.0722F * channel(2);
    if (channels % 2 == 1) return grey;
    const float alpha = channel(channels - 1);
    return grey * alpha + (1.0F - alpha);
}

/// Reads all pixels row by row. A pass of an interlaced picture has only some rows and columns.
/// Also reads the end of the file, to find out whether it is complete.
bool read_pixels(PngReader& reader, const Format& format, PictureChannel channel,
                 std::vector<png_byte>& row, std::vector<float>& values) {
    const bool is_interlaced = format.passes > 1;
    const auto width = static_cast<png_uint_32>(format.width);
    const auto height = static_cast<png_uint_32>(format.height);
    return reader.guarded([&] {
        for (int pass = 0; pass < format.passes; ++pass) {
            const std::size_t columns = is_interlaced ? PNG_PASS_COLS(width, pass) : width;
            const std::size_t rows = is_interlaced ? PNG_PASS_ROWS(height, pass) : height;
            for (std::size_t j = 0; j < rows && columns > 0; ++j) {
                png_read_row(reader.png(), row.data(), nullptr);
                const std::size_t y = is_interlaced ? PNG_ROW_FROM_PASS_ROW(j, pass) : j;
                for (std::size_t i = 0; i < columns; ++i) {
                    const std::size_t x = is_interlaced ? PNG_COL_FROM_PASS_COL(i, pass) : i;
                    values[y * width + x] = number_of(row.data(), i, format, channel);
                }
            }
        }
        png_read_end(reader.png(), nullptr);
    });
}

Failure damaged(const PngReader& reader) {
    return {fmt::format("the PNG file is cut off or damaged: {}", reader.error()), ""};
}

Result<GreyPicture> parse(std::string_view bytes, PictureChannel channel) {
    PngReader reader(bytes);
    Format format;
    if (!read_header(reader, format)) return tl::unexpected<Failure>(damaged(reader));
    if (format.width > most_pixels / format.height) {
        return failure(fmt::format("it has {} × {} pixels, and at most {} are read", format.width,
                                   format.height, most_pixels),
                       "make the picture smaller");
    }
    // For a large picture, counts at least a byte for each pixel. With fewer bits for each pixel, a
    // small file could otherwise make the reader use too much memory.
    const auto pixels = static_cast<std::uint64_t>(format.width * format.height);
    const std::uint64_t least =
        pixels > many_pixels ? std::max(pixels, format.packed_bytes) : format.packed_bytes;
    if (least / largest_growth > bytes.size()) {
        return failure("the PNG file is cut off or damaged: it is too short for its pixels");
    }
    if (!start_rows(reader, format)) return tl::unexpected<Failure>(damaged(reader));
    std::vector<png_byte> row(format.row_bytes);
    GreyPicture picture{format.width, format.height, std::vector<float>(pixels)};
    if (!read_pixels(reader, format, channel, row, picture.values)) {
        return tl::unexpected<Failure>(damaged(reader));
    }
    return picture;
}

}  // namespace

Result<GreyPicture> parse_grey_picture(std::string_view bytes, PictureChannel channel) {
    if (!has_png_signature(bytes)) return failure("it is not a PNG file");
    return enough_memory_for([&] { return parse(bytes, channel); });
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
