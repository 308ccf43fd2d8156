// Writes GIF films with giflib: CompuServe, "Graphics Interchange Format, Version 89a", 1990. The
// extension of Netscape 2.0 makes films repeat for ever.
#include "core/check.h"
#include "core/growing_file.h"
#include "film/colour_table.h"
#include "film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <gif_lib.h>
#include <utility>

namespace cascade {
namespace {

constexpr double gif_ticks_per_second = 100;
constexpr std::size_t most_colours = 256;

struct FreeTable {
    void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};
using Table = std::unique_ptr<ColorMapObject, FreeTable>;

/// A table of colours. The format requires a power of two as its size.
Table table_of(const std::vector<PackedColour>& colours, std::size_t count) {
    const int bits = std::max(1, GifBitSize(static_cast<int>(count)));
    Table table(GifMakeMapObject(1 << bits, nullptr));
    if (!table) return table;
    for (std::size_t k = 0; k < colours.size(); ++k) {
        table->Colors[k] = {static_cast<GifByteType>(colours[k] >> 16 & 0xffU),
                            static_cast<GifByteType>(colours[k] >> 8 & 0xffU),
                            static_cast<GifByteType>(colours[k] & 0xffU)};
    }
    return table;
}

class GifWriter : public FilmWriter {
public:
    /// If `with_holes` is true, each frame first removes the previous one, because pixels of a GIF
    /// can be made transparent again in no other way.
    GifWriter(std::unique_ptr<GrowingFile> file, const FilmSettings& settings, bool with_holes,
              std::vector<PackedColour> colours)
        : file_(std::move(file)),
          times_(settings.frames_per_second, gif_ticks_per_second),
          with_holes_(with_holes),
          nearest_(std::move(colours)) {}
    ~GifWriter() override {
        if (gif_) EGifCloseFile(gif_, nullptr);
    }

    Result<void> begin(std::int64_t width, std::int64_t height) {
        int error = 0;
        gif_ = EGifOpen(this, put, &error);
        if (!gif_) return out_of_memory();
        EGifSetGifVersion(gif_, true);
        const Table table = table_of(nearest_.table(), nearest_.table().size() + with_holes_);
        if (!table) return out_of_memory();
        constexpr GifByteType for_ever[] = {1, 0, 0};
        const bool done = EGifPutScreenDesc(gif_, static_cast<int>(width), static_cast<int>(height),
                                            8, 0, table.get()) == GIF_OK &&
                          EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
                          EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0") == GIF_OK &&
                          EGifPutExtensionBlock(gif_, 3, for_ever) == GIF_OK &&
                          EGifPutExtensionTrailer(gif_) == GIF_OK;
        return outcome(done);
    }

    Result<void> add(const FilmFrame& frame) override {
        const FramePart part =
            before_.pixels.empty() || with_holes_ ? whole_of(frame) : changed_part(before_, frame);
        const auto own = own_colours(frame);
        const bool done = put_control(own) && put_pixels(frame, part, own);
        before_ = frame;
        return outcome(done);
    }

    Result<void> finish() override {
        CHECK(!before_.pixels.empty(), "a film has a frame");
        int error = 0;
        const bool done = EGifCloseFile(std::exchange(gif_, nullptr), &error) == GIF_OK;
        if (auto closed = outcome(done); !closed) return closed;
        return file_->complete();
    }

private:
    static int put(GifFileType* gif, const GifByteType* bytes, int count) {
        auto& self = *static_cast<GifWriter*>(gif->UserData);
        auto done = self.file_->append(
            {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count)});
        if (done) return count;
        if (!self.failed_) self.failed_ = done.error();
        return 0;
    }

    static tl::unexpected<Failure> out_of_memory() {
        return failure("there is not enough memory for a GIF film");
    }

    /// Converts giflib's result. giflib fails only if bytes cannot be written or memory is
    /// exhausted.
    Result<void> outcome(bool done) const {
        if (done) return {};
        if (failed_) return tl::unexpected(*failed_);
        return out_of_memory();
    }

    using OwnColours = std::optional<std::vector<PackedColour>>;

    /// The colours of a frame that gets its own table, because they are few and the film's table
    /// lacks some of them. Empty for other frames.
    OwnColours own_colours(const FilmFrame& frame) const {
        OwnColours own = few_colours(frame, most_colours - with_holes_);
        const std::vector<PackedColour>& table = nearest_.table();
        if (own && std::includes(table.begin(), table.end(), own->begin(), own->end())) own.reset();
        return own;
    }

    /// The index of the transparent colour, which follows the last colour of the table.
    int hole(const OwnColours& own) const {
        return static_cast<int>(own ? own->size() : nearest_.table().size());
    }

    bool put_control(const OwnColours& own) {
        GraphicsControlBlock control = {};
        control.DisposalMode = with_holes_ ? DISPOSE_BACKGROUND : DISPOSE_DO_NOT;
        control.DelayTime = static_cast<int>(times_.next());
        control.TransparentColor = with_holes_ ? hole(own) : NO_TRANSPARENT_COLOR;
        GifByteType bytes[4];
        const std::size_t count = EGifGCBToExtension(&control, bytes);
        return EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(count), bytes) ==
               GIF_OK;
    }

    bool put_pixels(const FilmFrame& frame, const FramePart& part, const OwnColours& own) {
        const Table map = own ? table_of(*own, own->size() + with_holes_) : nullptr;
        if (own && !map) return false;
        if (EGifPutImageDesc(gif_, static_cast<int>(part.x), static_cast<int>(part.y),
                             static_cast<int>(part.width), static_cast<int>(part.height), false,
                             map.get()) != GIF_OK) {
            return false;
        }
        std::vector<GifPixelType> line(static_cast<std::size_t>(part.width));
        for (std::int64_t y = part.y; y < part.y + part.height; ++y) {
            const unsigned char* pixel = frame.row(y, part.x);
            for (GifPixelType& number : line) {
                number = number_of(pixel, own);
                pixel += FilmFrame::pixel_bytes;
            }
            if (EGifPutLine(gif_, line.data(), static_cast<int>(line.size())) != GIF_OK) {
                return false;
            }
        }
        return true;
    }

    GifPixelType number_of(const unsigned char* pixel, const OwnColours& own) {
        if (with_holes_ && is_hole(pixel)) return static_cast<GifPixelType>(hole(own));
        if (!own) return nearest_(packed(pixel));
        const auto place = std::lower_bound(own->begin(), own->end(), packed(pixel));
        return static_cast<GifPixelType>(place - own->begin());
    }

    std::unique_ptr<GrowingFile> file_;
    FrameTimes times_;
    bool with_holes_;
    NearestColours nearest_;
    FilmFrame before_;
    GifFileType* gif_ = nullptr;
    std::optional<Failure> failed_;
};

}  // namespace

Result<std::unique_ptr<FilmWriter>> begin_gif(const std::filesystem::path& path,
                                              const FilmSettings& settings,
                                              std::span<const FilmFrame> samples) {
    const bool with_holes = std::any_of(samples.begin(), samples.end(), has_holes);
    std::vector<PackedColour> colours = chosen_colours(samples, most_colours - with_holes);
    if (colours.empty()) colours = {0xffffff};  // All pixels of the samples are transparent.
    auto file = GrowingFile::create(path);
    if (!file) return tl::unexpected(file.error());
    auto film =
        std::make_unique<GifWriter>(*std::move(file), settings, with_holes, std::move(colours));
    const FilmFrame& first = samples.front();
    if (auto begun = film->begin(first.width, first.height); !begun) {
        return tl::unexpected(begun.error());
    }
    return film;
}

}  // namespace cascade
