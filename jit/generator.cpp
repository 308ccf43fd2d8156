// Loads the module of the code generator.
#include "jit/generator.h"

#include "jit/processor.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>

namespace cascade {
namespace {

Result<const CodeGenerator*> load_generator() {
    // The module is never unloaded, because threads may compile until the program ends.
    void* module = ::dlopen(CASCADE_LLVM_MODULE, RTLD_LAZY | RTLD_LOCAL);
    if (!module) {
        const char* reason = ::dlerror();
        return failure(fmt::format("the code generator could not be loaded: {}",
                                   reason ? reason : "unknown reason"),
                       "use --backend interp, which works without it");
    }
    const auto entry = reinterpret_cast<GeneratorEntry*>(::dlsym(module, generator_symbol));
    const CodeGenerator* generator = entry ? entry(code_version()) : nullptr;
    if (!generator) {
        return failure(fmt::format("{} belongs to another build of this program",
                                   CASCADE_LLVM_MODULE),
                       "install this program and its modules again");
    }
    return generator;
}

}  // namespace

Result<const CodeGenerator*> code_generator() {
    static const Result<const CodeGenerator*> generator = load_generator();
    return generator;
}

Result<void> check_options(const JitOptions& options) {
    const int lanes = options.lanes;
    if (lanes != 0 && lanes != 4 && lanes != 8 && lanes != 16) {
        return failure(fmt::format("no vectors of {} cells", lanes), "4, 8 or 16");
    }
    if (options.optimise < 0 || options.optimise > 3) {
        return failure(fmt::format("no optimisation level {}", options.optimise), "0 to 3");
    }
    return {};
}

std::string llvm_identity() {
    struct stat status {};
    if (::stat(CASCADE_LLVM_LIBRARY, &status) != 0) return {};
    return fmt::format("{} {}.{}", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil,
                              const JitOptions& options) {
    if (auto good = check_options(options); !good) return tl::unexpected(good.error());
    const auto generator = code_generator();
    if (!generator) return tl::unexpected(generator.error());
    return (*generator)->dump_llvm(kernel, stencil, options);
}

Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options) {
    if (auto good = check_options(options); !good) return tl::unexpected(good.error());
    const auto generator = code_generator();
    if (!generator) return tl::unexpected(generator.error());
    return (*generator)->dump_assembly(kernel, stencil, options);
}

Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& cpu) {
    const auto generator = code_generator();
    if (!generator) return tl::unexpected(generator.error());
    return (*generator)->compile_object(content, stencil, cpu);
}

std::vector<std::string> known_targets() {
    const auto generator = code_generator();
    return generator ? (*generator)->known_targets() : std::vector<std::string>();
}

std::string describe_jit() {
    return fmt::format("LLVM {}{}, {} cells a vector", CASCADE_LLVM_VERSION,
                       llvm_identity().empty() ? " (not installed)" : "", host_lanes());
}

}  // namespace cascade
