// Shared libraries that are loaded at their first use: loading some takes longer than most
// commands.
#pragma once

namespace cascade {

/// The address of a function, which becomes a pointer to it where one is asked for.
struct LateFunction {
    void* address;
    template <typename Function>
    operator Function*() const {
        return reinterpret_cast<Function*>(address);
    }
};

/// Never unloaded, since libraries may leave threads or handlers behind.
class LateLibrary {
public:
    /// Loads the library of this file name, which is searched as the system's loader does. Aborts,
    /// with a message that names the library, if it cannot be loaded: it is installed with Cascade.
    explicit LateLibrary(const char* file);
    /// Aborts in the same way if the library has no such function.
    LateFunction operator[](const char* name) const;

private:
    const char* file_;
    void* handle_;
};

}  // namespace cascade
