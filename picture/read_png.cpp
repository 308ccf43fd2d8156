// Reads the text chunks of PNG files, which may come from strangers.
//
// libpng can easily read texts that precede the picture's data, but needs to inflate the picture to
// read later texts. So this reader goes through the chunks of the file, and gives libpng a short
// file for each text, with the header and that text alone. libpng checks and inflates the text
// within the limit that remains for all texts.
#include "core/enough_memory.h"
#include "core/file.h"
#include "picture/image.h"
#include "picture/png_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace cascade {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t{1} << 30;
constexpr std::size_t signature_size = 8;
// The length, name and checksum around a chunk's data.
constexpr std::size_t chunk_frame = 12;
constexpr std::size_t most_texts = 64;  // In a file with more texts, further texts are skipped.
// The keyword, with room for the other data of a text chunk.
constexpr std::size_t longest_keyword = 1024;

struct Chunk {
    std::string_view name;
    std::string_view whole;  ///< The chunk with its length, name and checksum.
};

/// The chunk at the start of `bytes`; nullopt if the chunk is incomplete.
std::optional<Chunk> first_chunk(std::string_view bytes) {
    if (bytes.size() < chunk_frame) return std::nullopt;
    const std::uint32_t size = png_get_uint_32(reinterpret_cast<png_const_bytep>(bytes.data()));
    if (size > PNG_UINT_31_MAX || size > bytes.size() - chunk_frame) return std::nullopt;
    return Chunk{bytes.substr(4, 4), bytes.substr(0, chunk_frame + size)};
}

/// The header and the texts of a PNG file.
struct HeaderAndTexts {
    std::string_view header;  ///< The header with the signature.
    /// The chunks of the texts, with length, name and checksum.
    std::vector<std::string_view> texts;
};

/// Finds the header and the texts. `bytes` must begin with a signature.
Result<HeaderAndTexts> find_texts(std::string_view bytes) {
    HeaderAndTexts found;
    for (std::size_t position = signature_size;;) {
        const std::optional<Chunk> chunk = first_chunk(bytes.substr(position));
        if (!chunk) return failure("the PNG file is cut off or damaged");
        const bool header = position == signature_size;
        if (header != (chunk->name == "IHDR")) return failure("the PNG file has no right header");
        position += chunk->whole.size();
        if (header) found.header = bytes.substr(0, position);
        if (chunk->name == "IEND") return found;
        const bool text = chunk->name == "tEXt" || chunk->name == "zTXt" || chunk->name == "iTXt";
        if (text && found.texts.size() < most_texts) found.texts.push_back(chunk->whole);
    }
}

/// Reads the chunks before the picture's data. Texts may take at most `room` bytes.
bool read_texts(PngReader& reader, std::size_t room) {
    return reader.open() && reader.guarded([&reader, room] {
        png_set_chunk_malloc_max(reader.png(), room + longest_keyword);
        // Benign errors of libpng, such as a text that cannot be inflated, count as errors, because
        // half a script is useless.
        png_set_benign_errors(reader.png(), 0);
        png_read_info(reader.png(), reader.info());
    });
}

std::span<const png_text> texts_of(const PngReader& reader) {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png(), reader.info(), &texts, &count);
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
    if (!has_png_signature(bytes)) return failure("it is not a PNG file");
    return enough_memory_for([&]() -> Result<PngTexts> {
        const Result<HeaderAndTexts> found = find_texts(bytes);
        if (!found) return tl::unexpected<Failure>(found.error());
        PngTexts texts;
        std::size_t room = longest_png_text;
        // A header without texts is also checked.
        const auto chunks = found->texts.empty() ? std::vector<std::string_view>{""} : found->texts;
        for (const std::string_view chunk : chunks) {
            // libpng stops at the chunk where the picture's data would begin.
            const std::string short_file =
                std::string(found->header).append(chunk).append("\0\0\0\0IDAT", 8);
            PngReader reader(short_file);
            if (!read_texts(reader, room)) {
                return failure(fmt::format("the PNG file is damaged: {}", reader.error()));
            }
            for (const png_text& text : texts_of(reader)) {
                std::string content = text_of(text);
                room -= std::min(room, content.size());
                texts.emplace(utf8_of_latin1(text.key), std::move(content));
            }
        }
        return texts;
    });
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
