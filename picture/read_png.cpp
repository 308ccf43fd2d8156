// The text chunks of PNG files. The files may come from anywhere.
//
// libpng reads texts before the picture's data with ease, those behind it only by inflating the
// picture. So we walk over the file's chunks ourselves and show libpng a short file: the header and
// the texts. It checks and inflates them within the limits set here.
// As in write_png.cpp, libpng's errors jump to Decoder::run over frames that own nothing.
#include "core/file.h"
#include "picture/image.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <optional>

namespace cascade {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t{4} << 30;
constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_frame = 12;  // Length, name and checksum around a chunk's data.
constexpr std::size_t most_texts = 64;   // More are passed over.
constexpr png_alloc_size_t text_room = longest_png_text + 1024;

struct Chunk {
    std::string_view name;
    std::string_view whole;  ///< With length, name and checksum.
};

/// The chunk at the start of `bytes`; nothing where they hold no whole one.
std::optional<Chunk> first_chunk(std::string_view bytes) {
    if (bytes.size() < chunk_frame) return std::nullopt;
    const std::uint32_t size = png_get_uint_32(reinterpret_cast<png_const_bytep>(bytes.data()));
    if (size > PNG_UINT_31_MAX || size > bytes.size() - chunk_frame) return std::nullopt;
    return Chunk{bytes.substr(4, 4), bytes.substr(0, chunk_frame + size)};
}

/// A PNG file that libpng reads up to its picture: the header and the texts of `bytes`, which begin
/// with a signature.
Result<std::string> file_of_texts(std::string_view bytes) {
    std::string file(bytes.substr(0, signature_size));
    std::size_t texts = 0;
    for (std::size_t position = signature_size;;) {
        const std::optional<Chunk> chunk = first_chunk(bytes.substr(position));
        if (!chunk) return failure("the PNG file is cut off or damaged");
        const bool header = position == signature_size;
        if (header != (chunk->name == "IHDR")) return failure("the PNG file has no right header");
        position += chunk->whole.size();
        if (chunk->name == "IEND") break;
        const bool text = chunk->name == "tEXt" || chunk->name == "zTXt" || chunk->name == "iTXt";
        if (header || (text && texts++ < most_texts)) file += chunk->whole;
    }
    // libpng stops where it sees the beginning of the picture's data.
    return file + std::string("\0\0\0\0IDAT", 8);
}

/// Reads a PNG's chunks up to the picture's data and keeps the texts.
class Decoder {
public:
    explicit Decoder(std::string_view bytes) : bytes_(bytes) {}
    ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    bool run();
    std::span<const png_text> texts() const;
    const char* error() const { return error_.data(); }

private:
    static void take(png_structp png, png_bytep data, png_size_t size);
    [[noreturn]] static void fail(png_structp png, png_const_charp message);

    std::string_view bytes_;
    std::size_t position_ = 0;
    std::array<char, 200> error_{};
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

void Decoder::take(png_structp png, png_bytep data, png_size_t size) {
    auto& self = *static_cast<Decoder*>(png_get_io_ptr(png));
    if (size > self.bytes_.size() - self.position_) png_error(png, "it ends too early");
    std::memcpy(data, self.bytes_.data() + self.position_, size);
    self.position_ += size;
}

void Decoder::fail(png_structp png, png_const_charp message) {
    auto& error = static_cast<Decoder*>(png_get_error_ptr(png))->error_;
    std::strncpy(error.data(), message, error.size() - 1);
    png_longjmp(png, 1);
}

bool Decoder::run() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](auto, auto) {});
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
        std::strncpy(error_.data(), "there is not enough memory", error_.size() - 1);
        return false;
    }
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, take);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_chunk_malloc_max(png_, text_room);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    // What libpng forgives elsewhere (a text that does not inflate, say) is an error here: a
    // picture is read for its script, and half a script is none.
    png_set_benign_errors(png_, 0);
    png_read_info(png_, info_);
    return true;
}

std::span<const png_text> Decoder::texts() const {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png_, info_, &texts, &count);
    return {texts, static_cast<std::size_t>(count)};
}

std::string utf8_of_latin1(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            out += c;
        } else {
            out += static_cast<char>(0xc0 | (byte >> 6));
            out += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return out;
}

std::string text_of(const png_text& chunk) {
    if (chunk.text == nullptr) return {};
    const bool unicode = chunk.compression == PNG_ITXT_COMPRESSION_NONE ||
                         chunk.compression == PNG_ITXT_COMPRESSION_zTXt;
    const std::string_view text(chunk.text, unicode ? chunk.itxt_length : chunk.text_length);
    return unicode ? std::string(text) : utf8_of_latin1(text);
}

}  // namespace

Result<PngTexts> parse_png_texts(std::string_view bytes) {
    const auto* start = reinterpret_cast<png_const_bytep>(bytes.data());
    if (bytes.size() < signature_size || png_sig_cmp(start, 0, signature_size) != 0) {
        return failure("it is not a PNG file");
    }
    try {
        const Result<std::string> short_file = file_of_texts(bytes);
        if (!short_file) return tl::unexpected<Failure>(short_file.error());
        Decoder decoder(*short_file);
        if (!decoder.run()) {
            return failure(fmt::format("the PNG file is damaged: {}", decoder.error()));
        }
        PngTexts texts;
        for (const png_text& chunk : decoder.texts()) {
            texts.emplace(utf8_of_latin1(chunk.key), text_of(chunk));
        }
        return texts;
    } catch (const std::bad_alloc&) {
        return failure("there is not enough memory");
    }
}

Result<PngTexts> read_png_texts(const std::filesystem::path& path) {
    const Result<std::string> bytes = read_file(path, largest_file);
    if (!bytes) return tl::unexpected<Failure>(bytes.error());
    Result<PngTexts> texts = parse_png_texts(*bytes);
    if (!texts) {
        return failure(fmt::format("cannot read '{}': {}", path.string(), texts.error().message),
                       texts.error().hint);
    }
    return texts;
}

}  // namespace cascade
