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

/// The function of every kernel of float or double; see jit/skeleton.h.
template <typename Number>
using GridFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                          const Number* uniforms, Number* const* results, std::int64_t width,
                          std::int64_t stride, std::int64_t row_begin, std::int64_t row_end);

/// The same of grids of several slices.
template <typename Number>
using VolumeFunction = void(const Number* const* fields, const std::uint8_t* const* masks,
                            const Number* uniforms, Number* const* results, std::int64_t width,
                            std::int64_t stride, std::int64_t row_begin, std::int64_t row_end,
                            std::int64_t slice_rows, std::int64_t slice);

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
