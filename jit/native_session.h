// Machine code that is loaded into this process, by LLVM's ORC.
//
// Internal to jit/.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace cascade {

/// The function of every kernel; see jit/skeleton_grid.h.
using GridFunction = void(const float* const* fields, const std::uint8_t* const* masks,
                          const float* uniforms, float* const* results, std::int64_t width,
                          std::int64_t stride, std::int64_t row_begin, std::int64_t row_end);

/// The same of grids of several slices.
using VolumeFunction = void(const float* const* fields, const std::uint8_t* const* masks,
                            const float* uniforms, float* const* results, std::int64_t width,
                            std::int64_t stride, std::int64_t row_begin, std::int64_t row_end,
                            std::int64_t slice_rows, std::int64_t slice);

/// A loaded function; its memory is freed with it.
class LoadedFunction {
public:
    virtual ~LoadedFunction() = default;
    GridFunction* address = nullptr;           ///< Of a kernel for grids of one slice,
    VolumeFunction* volume_address = nullptr;  ///< and for others: the caller knows which it is.
};

/// Links and loads object files. Safe to use by one thread at a time; functions that it loaded keep
/// it alive.
class NativeSession {
public:
    static Result<std::shared_ptr<NativeSession>> make();
    virtual ~NativeSession() = default;

    /// Loads an object file and finds `name` in it. The name must be new to the session.
    virtual Result<std::unique_ptr<LoadedFunction>> load(std::span<const char> object,
                                                         const std::string& name) = 0;
};

}  // namespace cascade
