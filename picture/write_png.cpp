// Writes PNG files by libpng, into memory first.
//
// libpng reports errors by longjmp to Encoder::run. This is safe because the skipped frames own
// nothing: all objects with a destructor are in encode_png, outside the jump.
#include "core/check.h"
#include "core/write_encoded.h"
#include "picture/image.h"
#include "picture/srgb.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>

namespace cascade {
namespace {

constexpr std::int64_t longest_side = 0x7fffffff;  // The format's limit.
constexpr std::size_t longest_plain_text = 1024;   // Longer ones are compressed.

bool some_transparent(const Image& image) {
    return std::any_of(image.pixels.begin(), image.pixels.end(), is_transparent);
}

bool all_grey(const Image& image, unsigned highest) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [highest](const Colour& pixel) {
        const unsigned red = level_of(pixel[0], highest);
        return red == level_of(pixel[1], highest) && red == level_of(pixel[2], highest);
    });
}

/// The data of one encoding, prepared so that `run` makes no C++ allocations.
class Encoder {
public:
    Encoder(const Image& image, PngDepth depth, const PngTexts& texts, PngMeaning meaning,
            PngEffort effort);
    ~Encoder() { png_destroy_write_struct(&png_, &info_); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    bool run();
    std::string take_bytes() { return std::move(bytes_); }
    const char* error() const { return error_.data(); }

private:
    static void append(png_structp png, png_bytep data, png_size_t size);
    [[noreturn]] static void fail(png_structp png, png_const_charp message);
    void fill_row(std::int64_t y);

    const Image& image_;
    PngMeaning meaning_;
    PngEffort effort_;
    int depth_;
    bool grey_;
    bool alpha_;
    std::size_t channels_;         // Per pixel in the file.
    std::vector<png_text> texts_;  // Point into the caller's texts.
    std::vector<png_byte> row_;
    std::string bytes_;
    std::array<char, 200> error_{};
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

Encoder::Encoder(const Image& image, PngDepth depth, const PngTexts& texts, PngMeaning meaning,
                 PngEffort effort)
    : image_(image),
      meaning_(meaning),
      effort_(effort),
      depth_(static_cast<int>(depth)),
      grey_(all_grey(image, (1U << depth_) - 1)),
      alpha_(some_transparent(image)),
      channels_((grey_ ? 1U : 3U) + (alpha_ ? 1U : 0U)),
      row_(static_cast<std::size_t>(image.width) * channels_ *
           static_cast<std::size_t>(depth_ / 8)) {
    for (const auto& [keyword, text] : texts) {
        png_text chunk{};
        const bool compressed = text.size() > longest_plain_text;
        chunk.compression = compressed ? PNG_ITXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_NONE;
        // libpng 1.6 copies both texts and never writes through these pointers.
        chunk.key = const_cast<char*>(keyword.c_str());
        chunk.text = const_cast<char*>(text.c_str());
        chunk.itxt_length = text.size();
        texts_.push_back(chunk);
    }
}

void Encoder::append(png_structp png, png_bytep data, png_size_t size) {
    auto& bytes = static_cast<Encoder*>(png_get_io_ptr(png))->bytes_;
    bool appended = true;
    try {
        bytes.append(reinterpret_cast<const char*>(data), size);
    } catch (const std::bad_alloc&) {
        appended = false;
    }
    // Outside of the handler, because a jump out of it would leak the exception.
    if (!appended) png_error(png, "there is not enough memory");
}

void Encoder::fail(png_structp png, png_const_charp message) {
    auto& error = static_cast<Encoder*>(png_get_error_ptr(png))->error_;
    std::strncpy(error.data(), message, error.size() - 1);
    png_longjmp(png, 1);
}

void Encoder::fill_row(std::int64_t y) {
    const unsigned highest = (1U << depth_) - 1;
    const std::size_t colours = channels_ - (alpha_ ? 1 : 0);
    png_byte* out = row_.data();
    for (std::int64_t x = 0; x < image_.width; ++x) {
        const Colour& pixel = image_.at(x, y);
        const bool is_seen = !is_transparent(pixel);
        for (std::size_t channel = 0; channel < channels_; ++channel) {
            // Transparent pixels are white, for programs that ignore alpha.
            const unsigned value = channel == colours ? (is_seen ? highest : 0)
                                   : is_seen          ? level_of(pixel[channel], highest)
                                                      : highest;
            if (depth_ == 16) *out++ = static_cast<png_byte>(value >> 8);
            *out++ = static_cast<png_byte>(value & 0xffU);
        }
    }
}

bool Encoder::run() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, [](auto, auto) {});
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
        std::strncpy(error_.data(), "there is not enough memory", error_.size() - 1);
        return false;
    }
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, this, append, nullptr);
    png_set_user_limits(png_, longest_side, longest_side);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image_.width),
                 static_cast<png_uint_32>(image_.height), depth_,
                 (grey_ ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB) |
                     (alpha_ ? PNG_COLOR_MASK_ALPHA : 0),
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (effort_ == PngEffort::fast) {
        png_set_compression_level(png_, 1);
        png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    }
    if (meaning_ == PngMeaning::colours) png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png_, info_, texts_.data(), static_cast<int>(texts_.size()));
    png_write_info(png_, info_);
    for (std::int64_t y = 0; y < image_.height; ++y) {
        fill_row(y);
        png_write_row(png_, row_.data());
    }
    png_write_end(png_, nullptr);
    return true;
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
    try {
        Encoder encoder(image, depth, texts, meaning, effort);
        if (!encoder.run()) return failure(encoder.error());
        return encoder.take_bytes();
    } catch (const std::bad_alloc&) {
        return failure("there is not enough memory");
    }
}

Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts) {
    return write_encoded(path, [&] { return encode_png(image, depth, texts); });
}

}  // namespace cascade
