// Finds shared files by the path of the running code, so that an installed Cascade may be moved.
#include "core/shared_files.h"

#include <dlfcn.h>

#include <system_error>

namespace cascade {

std::filesystem::path shared_file(const std::filesystem::path& name) {
    namespace fs = std::filesystem;
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    // Asks for the file that contains this code. If that file is a library, the running program may
    // be Python.
    Dl_info object{};
    const bool found = ::dladdr(reinterpret_cast<const void*>(&shared_file), &object) != 0;
    const fs::path library = found && object.dli_fname ? object.dli_fname : "";
    for (const fs::path& code : {program, fs::canonical(library, unknown)}) {
        if (code.empty()) continue;
        for (const char* folder : {".", "../share/cascade"}) {
            const fs::path path = (code.parent_path() / folder / name).lexically_normal();
            if (fs::exists(path, unknown)) return path;
        }
    }
    return {};
}

}  // namespace cascade
