// The common part of the PNG readers, which calls libpng on bytes in memory. Only the files of
// picture/ include this header.
//
// libpng reports an error by a longjmp into guarded(). The jump leaves the functions in between
// without calling destructors. So actions must not contain objects with destructors.
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

    /// Creates libpng's structures. If memory is exhausted, sets an error and returns false.
    bool open();

    /// Runs an action that calls libpng. If libpng fails, sets an error and returns false.
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

/// Whether the bytes begin with the signature of PNG files.
bool has_png_signature(std::string_view bytes);

}  // namespace cascade
