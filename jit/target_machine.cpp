// Looks up target machines and their features.
#include "jit/target_machine.h"

#include "jit/llvm_module.h"

#include <fmt/format.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/TargetParser/X86TargetParser.h>

#include <algorithm>

namespace cascade {
namespace {

/// Registers the host's code generator with LLVM. Returns whether LLVM has a code generator for
/// this host.
bool initialise_target() {
    static const bool done =
        !llvm::InitializeNativeTarget() && !llvm::InitializeNativeTargetAsmPrinter();
    return done;
}

std::string host_features() {
    llvm::SubtargetFeatures features;
    for (const auto& feature : llvm::sys::getHostCPUFeatures()) {
        features.AddFeature(feature.getKey(), feature.getValue());
    }
    return features.getString();
}

llvm::CodeGenOptLevel codegen_level(int optimise) {
    switch (optimise) {
        case 0: return llvm::CodeGenOptLevel::None;
        case 1: return llvm::CodeGenOptLevel::Less;
        case 2: return llvm::CodeGenOptLevel::Default;
        default: return llvm::CodeGenOptLevel::Aggressive;
    }
}

Result<std::unique_ptr<llvm::TargetMachine>> make_target_machine(const std::string& cpu,
                                                                 int optimise) {
    if (!initialise_target()) return failure("LLVM has no code generator for this machine");
    if (!cpu.empty()) {
        const std::vector<std::string> known = llvm_module::known_targets();
        if (std::find(known.begin(), known.end(), cpu) == known.end()) {
            return failure(fmt::format("code cannot be made for the processor '{}'", cpu),
                           known.empty() ? "on this machine, code can be made only for its own "
                                           "processor"
                                         : "use x86-64, x86-64-v2, x86-64-v3 or x86-64-v4, for "
                                           "example");
        }
    }
    const std::string triple = llvm::sys::getProcessTriple();
    std::string error;
    const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple, error);
    if (!target) return failure(fmt::format("no native code for {}: {}", triple, error));
    llvm::TargetOptions options;
    options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
    std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
        triple, cpu.empty() ? host_cpu_name() : cpu, cpu.empty() ? host_features() : "", options,
        llvm::Reloc::PIC_, llvm::CodeModel::Small, codegen_level(optimise)));
    if (!machine) return failure(fmt::format("no native code for {}", triple));
    return machine;
}

}  // namespace

std::string host_cpu_name() { return llvm::sys::getHostCPUName().str(); }

std::vector<std::string> llvm_module::known_targets() {
    llvm::SmallVector<llvm::StringRef, 128> names;
    if (llvm::Triple(llvm::sys::getProcessTriple()).isX86()) {
        llvm::X86::fillValidCPUArchList(names, /*Only64Bit=*/true);
    }
    std::vector<std::string> targets;
    for (const llvm::StringRef name : names) targets.push_back(name.str());
    std::sort(targets.begin(), targets.end());
    return targets;
}

Result<TargetChoice> choose_target(const std::string& cpu, const JitOptions& options) {
    auto machine = make_target_machine(cpu, options.optimise);
    if (!machine) return tl::unexpected(machine.error());
    const int widest = widest_lanes(**machine);
    return TargetChoice{std::move(*machine), options.lanes == 0 ? widest : options.lanes};
}

int widest_lanes(const llvm::TargetMachine& machine) {
    const llvm::MCSubtargetInfo& features = *machine.getMCSubtargetInfo();
    if (!machine.getTargetTriple().isX86()) return 4;
    if (features.checkFeatures("+avx512f")) return 16;
    return features.checkFeatures("+avx") ? 8 : 4;
}

bool has_multiply_add(const llvm::TargetMachine& machine) {
    const llvm::Triple& triple = machine.getTargetTriple();
    if (!triple.isX86()) return triple.isAArch64();
    return machine.getMCSubtargetInfo()->checkFeatures("+fma");
}

bool is_short_of_loads(const llvm::TargetMachine& machine) {
    return machine.getTargetCPU() == "znver4" && widest_lanes(machine) == 16;
}

bool has_fast_gathers(const llvm::TargetMachine& machine) {
    return machine.getTargetTriple().isX86() &&
           machine.getMCSubtargetInfo()->checkFeatures("+avx2,+serialize");
}

bool has_rounding(const llvm::TargetMachine& machine) {
    const llvm::Triple& triple = machine.getTargetTriple();
    if (!triple.isX86()) return triple.isAArch64();
    return machine.getMCSubtargetInfo()->checkFeatures("+sse4.1");
}

KernelShape tuned(KernelShape shape, const llvm::TargetMachine& machine) {
    shape.has_multiply_add = has_multiply_add(machine);
    shape.is_short_of_loads = is_short_of_loads(machine);
    shape.has_fast_gathers = has_fast_gathers(machine) && shape.lanes >= 8;
    shape.has_rounding = has_rounding(machine);
    shape.has_scaling = widest_lanes(machine) == 16;
    return shape;
}

void set_target(llvm::Function& function, const llvm::TargetMachine& machine, int vector_bytes) {
    function.addFnAttr("target-cpu", machine.getTargetCPU());
    function.addFnAttr("target-features", machine.getTargetFeatureString());
    // Without this attribute, LLVM would split vectors on processors for which it prefers narrower
    // vectors.
    const std::string bits = std::to_string(8 * vector_bytes);
    function.addFnAttr("prefer-vector-width", bits);
    function.addFnAttr("min-legal-vector-width", bits);
    function.addFnAttr("denormal-fp-math", "preserve-sign,preserve-sign");
    function.addFnAttr("denormal-fp-math-f32", "preserve-sign,preserve-sign");
}

}  // namespace cascade
