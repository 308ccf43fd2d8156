// The callbacks of libpng. They read bytes from memory, and leave by longjmp on an error.
#include "picture/png_reader.h"

#include <cstring>

namespace cascade {

bool PngReader::open() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](auto, auto) {});
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
        std::strncpy(error_.data(), "there is not enough memory", error_.size() - 1);
        return false;
    }
    return guarded([this] {
        png_set_read_fn(png_, this, take);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    });
}

void PngReader::take(png_structp png, png_bytep data, png_size_t size) {
    auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > self.bytes_.size() - self.position_) png_error(png, "it ends too early");
    std::memcpy(data, self.bytes_.data() + self.position_, size);
    self.position_ += size;
}

void PngReader::fail(png_structp png, png_const_charp message) {
    auto& error = static_cast<PngReader*>(png_get_error_ptr(png))->error_;
    std::strncpy(error.data(), message, error.size() - 1);
    png_longjmp(png, 1);
}

bool has_png_signature(std::string_view bytes) {
    constexpr std::size_t signature_size = 8;
    const auto* start = reinterpret_cast<png_const_bytep>(bytes.data());
    return bytes.size() >= signature_size && png_sig_cmp(start, 0, signature_size) == 0;
}

}  // namespace cascade
