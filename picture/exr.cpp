// Uses the C interface of OpenEXR, which is loaded when the first file is written.
#include "picture/exr.h"

#include "core/check.h"
#include "core/late_library.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace cascade {

namespace {

/// Pointers to OpenEXR's functions. Their names lack the prefix `exr_`.
struct OpenExr {
    LateLibrary library{CASCADE_OPENEXR_LIBRARY};
    decltype(&exr_start_write) start_write = library["exr_start_write"];
    decltype(&exr_add_part) add_part = library["exr_add_part"];
    decltype(&exr_initialize_required_attr_simple) set_size =
        library["exr_initialize_required_attr_simple"];
    decltype(&exr_add_channel) add_channel = library["exr_add_channel"];
    decltype(&exr_write_header) write_header = library["exr_write_header"];
    decltype(&exr_get_scanlines_per_chunk) rows_of_block = library["exr_get_scanlines_per_chunk"];
    decltype(&exr_write_scanline_chunk_info) block_info = library["exr_write_scanline_chunk_info"];
    decltype(&exr_encoding_initialize) begin_block = library["exr_encoding_initialize"];
    decltype(&exr_encoding_update) next_block = library["exr_encoding_update"];
    decltype(&exr_encoding_choose_default_routines) choose_routines =
        library["exr_encoding_choose_default_routines"];
    decltype(&exr_encoding_run) run = library["exr_encoding_run"];
    decltype(&exr_encoding_destroy) end_blocks = library["exr_encoding_destroy"];
    decltype(&exr_finish) finish = library["exr_finish"];
};

const OpenExr& openexr() {
    static const OpenExr functions;
    return functions;
}

std::int64_t write_bytes(exr_const_context_t, void* file, const void* bytes, std::uint64_t count,
                         std::uint64_t offset, exr_stream_error_func_ptr_t) {
    std::string& into = *static_cast<std::string*>(file);
    const auto end = static_cast<std::size_t>(offset + count);
    if (into.size() < end) into.resize(end);
    std::memcpy(into.data() + offset, bytes, static_cast<std::size_t>(count));
    return static_cast<std::int64_t>(count);
}

void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

/// A file that is being written.
class ExrFile {
public:
    ExrFile(std::int64_t width, std::int64_t height, std::span<const ExrChannel> channels)
        : exr_(openexr()), width_(width), height_(height), channels_(channels) {}
    ~ExrFile() {
        if (has_blocks_) exr_.end_blocks(context_, &blocks_);
        if (context_) exr_.finish(&context_);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    Result<std::string> encode() {
        exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
        start.user_data = &bytes_;
        start.write_fn = &write_bytes;
        start.error_handler_fn = &say_nothing;
        const bool is_written =
            is_good(exr_.start_write(&context_, "memory", EXR_WRITE_FILE_DIRECTLY, &start)) &&
            write_header() && write_blocks() && finish();
        if (!is_written) return failure("the OpenEXR file could not be encoded");
        return std::move(bytes_);
    }

private:
    static bool is_good(exr_result_t result) { return result == EXR_ERR_SUCCESS; }

    bool write_header() {
        int part = 0;
        if (!is_good(exr_.add_part(context_, "maps", EXR_STORAGE_SCANLINE, &part))) return false;
        if (!is_good(exr_.set_size(context_, part, static_cast<std::int32_t>(width_),
                                   static_cast<std::int32_t>(height_), EXR_COMPRESSION_ZIP))) {
            return false;
        }
        for (const ExrChannel& channel : channels_) {
            const auto type = channel.is_half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
            const auto added = exr_.add_channel(context_, part, channel.name.c_str(), type,
                                                EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
            if (!is_good(added)) return false;
        }
        return is_good(exr_.write_header(context_));
    }

    bool write_blocks() {
        std::int32_t rows = 0;
        if (!is_good(exr_.rows_of_block(context_, 0, &rows))) return false;
        for (std::int64_t row = 0; row < height_; row += rows) {
            exr_chunk_info_t block;
            if (!is_good(exr_.block_info(context_, 0, static_cast<int>(row), &block)) ||
                !begin_block(block)) {
                return false;
            }
            for (int c = 0; c < blocks_.channel_count; ++c) fill(blocks_.channels[c], row);
            if (!has_blocks_ && !is_good(exr_.choose_routines(context_, 0, &blocks_))) return false;
            has_blocks_ = true;
            if (!is_good(exr_.run(context_, 0, &blocks_))) return false;
        }
        return true;
    }

    bool begin_block(const exr_chunk_info_t& block) {
        return is_good(has_blocks_ ? exr_.next_block(context_, 0, &block, &blocks_)
                                   : exr_.begin_block(context_, 0, &block, &blocks_));
    }

    /// Fills in a channel. The channel is found by its name, because the library has sorted
    /// channels.
    void fill(exr_coding_channel_info_t& into, std::int64_t row) const {
        const auto channel =
            std::find_if(channels_.begin(), channels_.end(),
                         [&](const ExrChannel& each) { return each.name == into.channel_name; });
        CHECK(channel != channels_.end(), "the file has the channels that were added");
        const auto step = static_cast<std::int64_t>(channel->step);
        into.user_bytes_per_element = sizeof(float);
        into.user_data_type = EXR_PIXEL_FLOAT;
        into.user_pixel_stride = static_cast<std::int32_t>(step * sizeof(float));
        into.user_line_stride = static_cast<std::int32_t>(width_ * step * sizeof(float));
        into.encode_from_ptr =
            reinterpret_cast<const std::uint8_t*>(channel->first + row * width_ * step);
    }

    bool finish() {
        has_blocks_ = false;
        const bool is_ended = is_good(exr_.end_blocks(context_, &blocks_));
        return is_good(exr_.finish(&context_)) && is_ended;
    }

    const OpenExr& exr_;
    std::int64_t width_, height_;
    std::span<const ExrChannel> channels_;
    std::string bytes_;
    exr_context_t context_ = nullptr;
    exr_encode_pipeline_t blocks_ = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool has_blocks_ = false;
};

}  // namespace

Result<std::string> encode_exr(std::int64_t width, std::int64_t height,
                               std::span<const ExrChannel> channels) {
    return ExrFile(width, height, channels).encode();
}

}  // namespace cascade
