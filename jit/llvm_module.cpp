// The only symbol of the module, and the target machines that make code.
#include "jit/llvm_module.h"

#include "jit/code.h"
#include "jit/link_image.h"
#include "jit/target_machine.h"

#include <fmt/format.h>
#include <llvm/Config/llvm-config.h>

#include <algorithm>
#include <cstring>
#include <mutex>

namespace cascade {
namespace llvm_module {
namespace {

/// Target machines that are not in use. They are kept, because making one takes a good part of the
/// time of compiling a kernel. Only one thread at a time may use a machine.
class IdleMachines {
public:
    /// Takes a machine with this optimisation level. Null if none is idle.
    std::unique_ptr<llvm::TargetMachine> take(int optimise) {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(machines_.begin(), machines_.end(),
                                        [&](const auto& entry) { return entry.first == optimise; });
        if (found == machines_.end()) return nullptr;
        auto machine = std::move(found->second);
        machines_.erase(found);
        return machine;
    }
    void give_back(int optimise, std::unique_ptr<llvm::TargetMachine> machine) {
        const std::lock_guard lock(mutex_);
        machines_.emplace_back(optimise, std::move(machine));
    }

private:
    std::mutex mutex_;
    std::vector<std::pair<int, std::unique_ptr<llvm::TargetMachine>>> machines_;
};

Result<CodeImage> compile_on(llvm::TargetMachine& machine, const CellKernel& kernel,
                             const KernelShape& shape) {
    constexpr const char* name = "kernel";
    auto code = make_code(kernel, shape, name, machine);
    if (!code) return tl::unexpected(code.error());
    const auto object = generate(*code, machine, CodeForm::object);
    if (!object) return tl::unexpected(object.error());
    return link_image({object->data(), object->size()}, name);
}

}  // namespace

Result<CodeImage> compile(const CellKernel& kernel, const KernelShape& shape, int optimise) {
    static IdleMachines idle;
    auto machine = idle.take(optimise);
    if (!machine) {
        auto target = choose_target("", {0, optimise});
        if (!target) return tl::unexpected(target.error());
        machine = std::move(target->machine);
    }
    auto image = compile_on(*machine, kernel, shape);
    idle.give_back(optimise, std::move(machine));
    return image;
}

}  // namespace llvm_module
}  // namespace cascade

extern "C" __attribute__((visibility("default"))) const cascade::CodeGenerator*
cascade_code_generator(const char* version) {
    using namespace cascade;
    static const CodeGenerator generator = {llvm_module::compile, llvm_module::dump_llvm,
                                            llvm_module::dump_assembly, llvm_module::compile_object,
                                            llvm_module::known_targets};
    return std::strcmp(version, code_version()) == 0 ? &generator : nullptr;
}
