// Machine code that is loaded into this process, by LLVM's ORC.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/code_image.h"

#include <memory>
#include <span>
#include <string>

namespace cascade {

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
