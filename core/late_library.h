// Shared libraries loaded at first use, because loading some of them takes longer than most
// commands.
#pragma once

namespace cascade {

/// The address of a function. Converts to any function pointer.
struct LateFunction {
    void* address;
    template <typename Function>
    operator Function*() const {
        return reinterpret_cast<Function*>(address);
    }
};

/// A shared library. It is never unloaded, since threads or handlers of the library may remain.
class LateLibrary {
public:
    /// Loads the library of this file name from the system's search path. If that fails, aborts
    /// with a message that names the library, because it is installed with Cascade.
    explicit LateLibrary(const char* file);
    /// The function of this name. Aborts with a message if the library lacks it.
    LateFunction operator[](const char* name) const;

private:
    const char* file_;
    void* handle_;
};

}  // namespace cascade
