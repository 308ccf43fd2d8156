// Writes animated WebP files without loss: Google, "WebP Container Specification", 2011. libwebp
// encodes the frames. The container is written here, frame by frame, because libwebpmux would hold
// all frames in memory.
#include "core/check.h"
#include "core/growing_file.h"
#include "film/film.h"

#include <fmt/format.h>

#include <utility>
#include <webp/encode.h>

namespace cascade {
namespace {

constexpr double webp_ticks_per_second = 1000;
constexpr std::uint64_t largest_file = 0xfffffff0U;
constexpr std::size_t frame_header = 16;  // Bytes of a frame before its picture.
constexpr std::size_t file_header = 12;   // "RIFF", the size, and "WEBP".

/// From 0 (fast) to 9 (small). Higher efforts take twice the time and save a few percent.
constexpr int webp_effort = 2;

std::string little_endian(std::uint64_t number, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(number >> 8 * k & 0xffU);
    return text;
}

/// Enlarges a part so that it begins at an even pixel, as the format requires.
FramePart at_even(FramePart part) {
    part.width += part.x % 2;
    part.height += part.y % 2;
    part.x -= part.x % 2;
    part.y -= part.y % 2;
    return part;
}

class Picture {
public:
    Picture() {
        good_ = WebPPictureInit(&picture_) != 0;
        picture_.use_argb = 1;
    }
    ~Picture() { WebPPictureFree(&picture_); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// Encodes a part as a separate file. Empty if memory is exhausted.
    std::string encoded(const FilmFrame& frame, const FramePart& part) {
        WebPConfig config;
        picture_.width = static_cast<int>(part.width);
        picture_.height = static_cast<int>(part.height);
        std::string bytes;
        picture_.writer = append;
        picture_.custom_ptr = &bytes;
        good_ = good_ && WebPConfigInit(&config) != 0 &&
                WebPConfigLosslessPreset(&config, webp_effort) != 0 &&
                WebPPictureImportRGBA(&picture_, frame.row(part.y, part.x),
                                      static_cast<int>(frame.width * 4)) != 0 &&
                WebPEncode(&config, &picture_) != 0;
        return good_ ? bytes : "";
    }

private:
    static int append(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) {
        static_cast<std::string*>(picture->custom_ptr)
            ->append(reinterpret_cast<const char*>(data), size);
        return 1;
    }

    WebPPicture picture_ = {};
    bool good_ = false;
};

class WebpWriter : public FilmWriter {
public:
    WebpWriter(std::unique_ptr<GrowingFile> file, const FilmSettings& settings)
        : file_(std::move(file)), times_(settings.frames_per_second, webp_ticks_per_second) {}

    Result<void> begin(std::int64_t width, std::int64_t height) {
        constexpr unsigned animated = 2, with_alpha = 16;
        return file_->append(
            riff_header() +
            chunk("VP8X", little_endian(animated | with_alpha, 4) +
                              little_endian(static_cast<std::uint64_t>(width - 1), 3) +
                              little_endian(static_cast<std::uint64_t>(height - 1), 3)) +
            // The background is white. The 0 makes the animation repeat for ever.
            chunk("ANIM", little_endian(0xffffffffU, 4) + little_endian(0, 2)));
    }

    Result<void> add(const FilmFrame& frame) override {
        const FramePart part =
            at_even(before_.pixels.empty() ? whole_of(frame) : changed_part(before_, frame));
        const std::string picture = Picture().encoded(frame, part);
        if (picture.size() < file_header) {
            return failure("there is not enough memory for a WebP film");
        }
        constexpr unsigned without_blending = 2;
        std::string data;
        for (const std::int64_t number :
             {part.x / 2, part.y / 2, part.width - 1, part.height - 1, times_.next()}) {
            data += little_endian(static_cast<std::uint64_t>(number), 3);
        }
        data += little_endian(without_blending, 1);
        CHECK(data.size() == frame_header, "frames of WebP have a header of 16 bytes");
        data.append(picture, file_header);
        before_ = frame;
        if (file_->size() + data.size() > largest_file) {
            return failure("the film is larger than the 4 GiB of a WebP file",
                           "use another format, or fewer or smaller frames");
        }
        return file_->append(chunk("ANMF", data));
    }

    Result<void> finish() override {
        CHECK(!before_.pixels.empty(), "a film has a frame");
        if (auto done = file_->overwrite(0, riff_header()); !done) return done;
        return file_->complete();
    }

private:
    static std::string chunk(const char* name, const std::string& data) {
        return name + little_endian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
    }
    /// The header of the file. The size that it contains does not include the first 8 bytes of the
    /// file.
    std::string riff_header() const {
        const std::uint64_t size = file_->size() == 0 ? 0 : file_->size() - 8;
        return "RIFF" + little_endian(size, 4) + "WEBP";
    }

    std::unique_ptr<GrowingFile> file_;
    FrameTimes times_;
    FilmFrame before_;
};

}  // namespace

Result<std::unique_ptr<FilmWriter>> begin_webp(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples) {
    auto file = GrowingFile::create(path);
    if (!file) return tl::unexpected(file.error());
    auto film = std::make_unique<WebpWriter>(*std::move(file), settings);
    if (auto begun = film->begin(samples[0].width, samples[0].height); !begun)
        return tl::unexpected(begun.error());
    return film;
}

}  // namespace cascade
