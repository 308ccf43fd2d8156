// Machine code as bytes that may be loaded at any address.
//
// Internal to jit/. Kernels call no functions and read no constants of other code. So their code
// can be linked once (jit/link_image.h) into an image in which all addresses are relative. An image
// can be stored in a file and run by another process, without a linker and without LLVM.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <memory>
#include <string>

namespace cascade {

/// The type of the function of a kernel that fills columns of the halo. jit/skeleton_grid.h
/// explains the arguments.
template <typename Number>
using GridFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                          const Number* uniforms, Number* const* results, std::int64_t column_begin,
                          std::int64_t column_end, std::int64_t stride, std::int64_t row_begin,
                          std::int64_t row_end, std::int64_t is_near, std::int64_t left_column,
                          std::int64_t right_column);

/// The type of the function of a kernel for grids of several slices. Such a kernel fills no
/// columns.
template <typename Number>
using VolumeFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                            const Number* uniforms, Number* const* results,
                            std::int64_t column_begin, std::int64_t column_end, std::int64_t stride,
                            std::int64_t row_begin, std::int64_t row_end, std::int64_t is_near,
                            std::int64_t slice_rows, std::int64_t slice);

/// The type of the function of a kernel for linked cells. jit/skeleton_linked.h explains the
/// arguments.
template <typename Number>
using LinkedFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                            const Number* uniforms, Number* const* results,
                            std::int64_t column_begin, std::int64_t column_end, std::int64_t stride,
                            std::int64_t row_begin, std::int64_t row_end,
                            const std::uint32_t* starts, const std::int32_t* bases,
                            const std::int16_t* offsets, const Number* weights,
                            const Number* gradient_x, const Number* gradient_y,
                            const Number* gradient_z, const std::uint16_t* filled, Number* pairs,
                            std::int64_t first_of_pairs, std::int64_t end_of_pairs);

/// The code and constants of one function.
struct CodeImage {
    std::string bytes;        ///< Must be loaded at a multiple of `alignment`.
    std::uint64_t entry = 0;  ///< The offset of the function in `bytes`.

    /// The size of a page, because AArch64 instructions split an address into a page and an offset
    /// in the page.
    static constexpr std::uint64_t alignment = 4096;
};

/// A function in memory that may be executed but not written. The destructor frees the memory.
class LoadedFunction {
public:
    static Result<std::unique_ptr<LoadedFunction>> load(const CodeImage& image);

    ~LoadedFunction();
    LoadedFunction(const LoadedFunction&) = delete;
    LoadedFunction& operator=(const LoadedFunction&) = delete;

    /// The function, cast to `Function`, which must be its type.
    template <typename Function>
    Function* as() const {
        return reinterpret_cast<Function*>(pages_ + entry_);
    }

private:
    LoadedFunction(char* pages, const CodeImage& image)
        : pages_(pages), size_(image.bytes.size()), entry_(image.entry) {}

    char* pages_;
    std::size_t size_;
    std::uint64_t entry_;
};

}  // namespace cascade
