// The common part of the PNG readers (internal to picture/): libpng on bytes in memory.
//
// libpng reports errors by longjmp to `guarded`. This is safe only if the skipped frames have no
// destructors, so actions must not contain objects with a destructor.
#pragma once

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <string_view>

namespace cascade {

class PngReader {
public:
    explicit PngReader(std::string_view bytes) : bytes_(bytes) {}
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// Creates libpng's structures. Returns false, with an error, if memory runs out.
    bool open();

    /// Runs an action that calls libpng. Returns false, with an error, if libpng fails.
    template <typename Action>
    bool guarded(const Action& action) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        action();
        return true;
    }

    png_structp png() const { return png_; }
    png_infop info() const { return info_; }
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

/// Whether the bytes begin with the PNG signature.
bool has_png_signature(std::string_view bytes);

}  // namespace cascade
