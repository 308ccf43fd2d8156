// Loads images into executable memory.
#include "jit/code_image.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace cascade {

Result<std::unique_ptr<LoadedFunction>> LoadedFunction::load(const CodeImage& image) {
    const auto refused = [] {
        return failure(fmt::format("native code could not be loaded: {}",
                                   std::generic_category().message(errno)),
                       "the system may forbid programs to create code; use --backend interp, which "
                       "needs none");
    };
    const std::size_t size = image.bytes.size();
    void* memory =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return refused();
    char* pages = static_cast<char*>(memory);
    std::unique_ptr<LoadedFunction> function(new LoadedFunction(pages, image));
    std::memcpy(pages, image.bytes.data(), size);
    // Processors other than x86 may still have the old content of this memory in their instruction
    // cache.
    __builtin___clear_cache(pages, pages + size);
    if (::mprotect(pages, size, PROT_READ | PROT_EXEC) != 0) return refused();
    return function;
}

LoadedFunction::~LoadedFunction() { ::munmap(pages_, size_); }

}  // namespace cascade
