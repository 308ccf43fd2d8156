// Builds LLVM modules and generates machine code from them.
#include "jit/code.h"

#include "ir/multiply_add.h"
#include "ir/kernel_parts.h"
#include "jit/skeleton_grid.h"
#include "jit/skeleton_linked.h"
#include "jit/target_machine.h"

#include <fmt/format.h>
#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/raw_ostream.h>

namespace cascade {
namespace {

/// Collects LLVM's errors. Without a handler, LLVM prints them and may exit.
class ErrorCollector : public llvm::DiagnosticHandler {
public:
    explicit ErrorCollector(std::string& text) : text_(text) {}

    bool handleDiagnostics(const llvm::DiagnosticInfo& info) override {
        if (info.getSeverity() == llvm::DS_Error) {
            llvm::raw_string_ostream stream(text_);
            llvm::DiagnosticPrinterRawOStream printer(stream);
            info.print(printer);
        }
        return true;
    }

private:
    std::string& text_;
};

/// A function that calls `functions` in order and passes its own arguments to each.
llvm::Function* build_calls(llvm::Module& module, const std::vector<llvm::Function*>& functions,
                            const std::string& name) {
    auto* function = llvm::Function::Create(functions[0]->getFunctionType(),
                                            llvm::GlobalValue::ExternalLinkage, name, module);
    function->setDoesNotThrow();
    llvm::IRBuilder<> builder(llvm::BasicBlock::Create(module.getContext(), "entry", function));
    std::vector<llvm::Value*> arguments;
    for (llvm::Argument& argument : function->args()) arguments.push_back(&argument);
    for (llvm::Function* each : functions) builder.CreateCall(each, arguments);
    builder.CreateRetVoid();
    return function;
}

/// Sets the optimisation level of a machine. The destructor restores the old level.
class ScopedOptLevel {
public:
    ScopedOptLevel(llvm::TargetMachine& machine, llvm::CodeGenOptLevel level)
        : machine_(machine), level_(machine.getOptLevel()) {
        machine_.setOptLevel(level);
    }
    ~ScopedOptLevel() { machine_.setOptLevel(level_); }
    ScopedOptLevel(const ScopedOptLevel&) = delete;
    ScopedOptLevel& operator=(const ScopedOptLevel&) = delete;

private:
    llvm::TargetMachine& machine_;
    llvm::CodeGenOptLevel level_;
};

}  // namespace

CodeModule make_module(const llvm::TargetMachine& machine) {
    CodeModule code{std::make_unique<llvm::LLVMContext>(), nullptr, false};
    code.module = std::make_unique<llvm::Module>("cascade", *code.context);
    code.module->setDataLayout(machine.createDataLayout());
    code.module->setTargetTriple(machine.getTargetTriple().str());
    code.module->setPICLevel(llvm::PICLevel::BigPIC);
    return code;
}

Result<void> add_kernel(CodeModule& code, const CellKernel& kernel, const KernelShape& shape,
                        const std::string& name, const llvm::TargetMachine& machine) {
    const std::size_t size = size_of(kernel);
    if (size > largest_native_kernel) {
        return failure(
            fmt::format("a formula of size {} is too large for native code, which takes at most {}",
                        size, largest_native_kernel));
    }
    if (!has_multiply_add(machine) && multiplies_and_adds(kernel)) {
        return failure(fmt::format("the processor {} cannot multiply and add with one rounding, "
                                   "as --fast requires",
                                   machine.getTargetCPU().str()),
                       "use x86-64-v3, or leave --fast out");
    }
    const auto build = shape.stencil.links ? build_linked_function : build_grid_function;
    const std::vector<KernelPart> parts = parts_of(kernel);
    std::vector<llvm::Function*> functions;
    for (const KernelPart& part : parts) {
        code.is_large = code.is_large || size_of(part.kernel) > largest_optimised_kernel;
        const std::string own_name =
            parts.size() == 1 ? name : fmt::format("{}_part{}", name, functions.size() + 1);
        functions.push_back(build(*code.module, part, tuned(shape, machine), own_name));
    }
    if (parts.size() > 1) {
        for (llvm::Function* each : functions) each->setLinkage(llvm::Function::InternalLinkage);
        functions.push_back(build_calls(*code.module, functions, name));
    }
    for (llvm::Function* each : functions) {
        set_target(*each, machine, shape.lanes * static_cast<int>(bytes_of(kernel.precision)));
        std::string fault;
        llvm::raw_string_ostream stream(fault);
        if (llvm::verifyFunction(*each, &stream)) {
            return failure("the code of a kernel is not valid: " + stream.str());
        }
    }
    return {};
}

Result<CodeModule> make_code(const CellKernel& kernel, const KernelShape& shape,
                             const std::string& name, const llvm::TargetMachine& machine) {
    CodeModule code = make_module(machine);
    if (auto added = add_kernel(code, kernel, shape, name, machine); !added) {
        return tl::unexpected(added.error());
    }
    return code;
}

Result<llvm::SmallVector<char, 0>> generate(CodeModule& code, llvm::TargetMachine& machine,
                                            CodeForm form) {
    const ScopedOptLevel level(machine,
                               code.is_large ? llvm::CodeGenOptLevel::None : machine.getOptLevel());
    std::string errors;
    code.context->setDiagnosticHandler(std::make_unique<ErrorCollector>(errors));
    llvm::SmallVector<char, 0> bytes;
    llvm::raw_svector_ostream stream(bytes);
    llvm::legacy::PassManager passes;
    const auto type = form == CodeForm::object ? llvm::CodeGenFileType::ObjectFile
                                               : llvm::CodeGenFileType::AssemblyFile;
    if (machine.addPassesToEmitFile(passes, stream, nullptr, type)) {
        return failure("LLVM cannot write code for this processor");
    }
    passes.run(*code.module);
    if (!errors.empty()) return failure("LLVM refused a kernel: " + errors);
    return bytes;
}

}  // namespace cascade
