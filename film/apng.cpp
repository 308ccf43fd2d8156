// Writes animated PNG files: APNG Specification, Mozilla, version 1.0, 2008, now part of "Portable
// Network Graphics (PNG) Specification (Third Edition)", W3C, 2023. Every frame after the first
// contains only the part that has changed.
#include "core/check.h"
#include "core/growing_file.h"
#include "film/film.h"
#include "picture/deflate.h"
#include "picture/png_chunks.h"
#include "picture/png_rows.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cascade {
namespace {

constexpr int apng_effort = 6;  // The effort of compression.
constexpr std::size_t apng_ticks_per_second = 1000;

class ApngWriter : public FilmWriter {
public:
    ApngWriter(std::unique_ptr<GrowingFile> file, const FilmSettings& settings)
        : file_(std::move(file)), times_(settings.frames_per_second, apng_ticks_per_second) {}

    /// Writes what precedes the first frame.
    Result<void> begin(std::int64_t width, std::int64_t height, const PngTexts& texts) {
        std::string header(png_signature), size;
        append_big_endian(size, static_cast<std::size_t>(width));
        append_big_endian(size, static_cast<std::size_t>(height));
        // 8 bits of red, green, blue and alpha, the standard compression and filters, not
        // interlaced.
        append_chunk(header, "IHDR", size + std::string("\x08\x06\0\0\0", 5));
        place_of_count_ = header.size();
        header += count_chunk();
        append_srgb_chunk(header);
        append_texts(header, texts, apng_effort);
        return file_->append(header);
    }

    Result<void> add(const FilmFrame& frame) override {
        const FramePart part = frames_ == 0 ? whole_of(frame) : changed_part(before_, frame);
        std::string chunks;
        append_chunk(chunks, "fcTL", control(part));
        const std::string data = compressed(frame, part);
        for (std::size_t at = 0; at < data.size(); at += longest_png_data) {
            const auto piece = std::string_view(data).substr(at, longest_png_data);
            if (frames_ == 0) append_chunk(chunks, "IDAT", piece);
            else append_chunk(chunks, "fdAT", next_number().append(piece));
        }
        ++frames_;
        before_ = frame;
        return file_->append(chunks);
    }

    Result<void> finish() override {
        CHECK(frames_ > 0, "a film has a frame");
        std::string end;
        append_chunk(end, "IEND", {});
        if (auto done = file_->append(end); !done) return done;
        if (auto done = file_->overwrite(place_of_count_, count_chunk()); !done) return done;
        return file_->complete();
    }

private:
    /// The chunk that contains the number of frames and makes them repeat for ever.
    std::string count_chunk() const {
        std::string data, chunk;
        append_big_endian(data, frames_);
        append_big_endian(data, 0);
        append_chunk(chunk, "acTL", data);
        return chunk;
    }

    /// The sequence number of an animation chunk.
    std::string next_number() {
        std::string bytes;
        append_big_endian(bytes, chunks_++);
        return bytes;
    }

    std::string control(const FramePart& part) {
        std::string data = next_number();
        for (const std::int64_t number : {part.width, part.height, part.x, part.y}) {
            append_big_endian(data, static_cast<std::size_t>(number));
        }
        // Two numbers of 16 bits: the time of the frame in ticks, and the number of ticks
        // per second.
        append_big_endian(data,
                          static_cast<std::size_t>(times_.next()) << 16 | apng_ticks_per_second);
        // The frame stays after its time, and replaces the pixels below it.
        return data.append(2, '\0');
    }

    static std::string compressed(const FilmFrame& frame, const FramePart& part) {
        const std::size_t count = static_cast<std::size_t>(part.width) * FilmFrame::pixel_bytes;
        std::vector<std::uint8_t> rows((1 + count) * static_cast<std::size_t>(part.height));
        for (std::int64_t y = 0; y < part.height; ++y) {
            std::memcpy(&rows[(1 + count) * static_cast<std::size_t>(y) + 1],
                        frame.row(part.y + y, part.x), count);
        }
        filter_rows(rows, count, FilmFrame::pixel_bytes);
        return deflated({reinterpret_cast<const char*>(rows.data()), rows.size()}, apng_effort);
    }

    std::unique_ptr<GrowingFile> file_;
    FrameTimes times_;
    FilmFrame before_;
    std::size_t frames_ = 0, chunks_ = 0;
    std::uint64_t place_of_count_ = 0;
};

}  // namespace

Result<std::unique_ptr<FilmWriter>> begin_apng(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples) {
    if (auto checked = check_texts(settings.texts); !checked) {
        return tl::unexpected(checked.error());
    }
    auto file = GrowingFile::create(path);
    if (!file) return tl::unexpected(file.error());
    auto film = std::make_unique<ApngWriter>(*std::move(file), settings);
    if (auto begun = film->begin(samples[0].width, samples[0].height, settings.texts); !begun) {
        return tl::unexpected(begun.error());
    }
    return film;
}

}  // namespace cascade
