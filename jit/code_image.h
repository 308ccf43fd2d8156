// Machine code as bytes that run wherever they lie.
//
// Internal to jit/. Kernels call nothing and read only constants of their own, so what a code
// generator writes for them can be linked once, into an image whose parts address each other
// relative to themselves. An image can be kept in a file and run by another process, without a
// linker and without LLVM.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The function of every kernel of float or double; see jit/skeleton.h.
template <typename Number>
using GridFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                          const Number* uniforms, Number* const* results, std::int64_t width,
                          std::int64_t stride, std::int64_t row_begin, std::int64_t row_end,
                          std::int64_t is_near);

/// The same of grids of several slices.
template <typename Number>
using VolumeFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                            const Number* uniforms, Number* const* results, std::int64_t width,
                            std::int64_t stride, std::int64_t row_begin, std::int64_t row_end,
                            std::int64_t is_near, std::int64_t slice_rows, std::int64_t slice);

/// The same of linked cells; see jit/skeleton_linked.h.
template <typename Number>
using LinkedFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                            const Number* uniforms, Number* const* results, std::int64_t width,
                            std::int64_t stride, std::int64_t row_begin, std::int64_t row_end,
                            const std::uint32_t* starts, const std::int32_t* targets,
                            const Number* weights, const Number* gradient_x,
                            const Number* gradient_y, const Number* gradient_z);

/// A loaded function; its memory is freed with it.
class LoadedFunction {
public:
    virtual ~LoadedFunction() = default;
    std::uintptr_t address = 0;

    /// As a function of the type that the caller knows it to be.
    template <typename Function>
    Function* as() const {
        return reinterpret_cast<Function*>(address);
    }
};

/// Code and constants of one function.
struct CodeImage {
    std::string bytes;        ///< To lie at a multiple of `alignment`.
    std::uint64_t entry = 0;  ///< Where in the bytes the function begins.

    static constexpr std::uint64_t alignment = 64;
};

/// Links a relocatable object file (ELF, x86-64) to an image of its function `name`. Nothing where
/// the file is of another kind, refers to what is not in it, or has addresses that only a loader
/// knows.
std::optional<CodeImage> link_image(std::string_view object, std::string_view name);

/// Puts an image into memory that may be executed and not written.
Result<std::unique_ptr<LoadedFunction>> load_image(const CodeImage& image);

}  // namespace cascade
