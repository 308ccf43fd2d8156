// Writes kernels as object files, as LLVM IR and as assembly.
#include "jit/code.h"
#include "jit/llvm_module.h"
#include "jit/target_machine.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/GlobalVariable.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>

namespace cascade::llvm_module {
namespace {

/// The code of one kernel, with the machine for which it was made.
struct Compiled {
    TargetChoice target;
    CodeModule code;
};

Result<Compiled> compile_for(const CellKernel& kernel, Stencil stencil, const std::string& name,
                             const JitOptions& options) {
    auto target = choose_target("", options);
    if (!target) return tl::unexpected(target.error());
    const KernelShape shape = shape_for(kernel, stencil, target->lanes);
    auto code = make_code(kernel, shape, name, *target->machine);
    if (!code) return tl::unexpected(code.error());
    return Compiled{std::move(*target), std::move(*code)};
}

bool is_c_identifier(const std::string& name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(),
                       [&](char c) { return is_letter(c) || is_digit(c); });
}

void add_numbers(CodeModule& code, const NamedNumbers& numbers) {
    llvm::Constant* values = llvm::ConstantDataArray::get(
        *code.context, llvm::ArrayRef<float>(numbers.values.data(), numbers.values.size()));
    auto* variable =
        new llvm::GlobalVariable(*code.module, values->getType(), true,
                                 llvm::GlobalValue::ExternalLinkage, values, numbers.name);
    variable->setAlignment(llvm::Align(64));
}

Result<void> check_names(const ObjectContent& content) {
    const auto check = [](const std::string& name) -> Result<void> {
        if (is_c_identifier(name)) return {};
        return failure("'" + name + "' is not a name of C",
                       "use letters, digits and '_', with no digit in front");
    };
    for (const NamedKernel& function : content.functions) {
        if (auto good = check(function.name); !good) return good;
    }
    for (const NamedNumbers& numbers : content.numbers) {
        if (auto good = check(numbers.name); !good) return good;
    }
    return {};
}

}  // namespace

Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& cpu) {
    if (auto good = check_names(content); !good) return tl::unexpected(good.error());
    if (stencil.links) return failure("object files cannot be written for the cells of a model");
    auto target = choose_target(cpu, {});
    if (!target) return tl::unexpected(target.error());
    CodeModule code = make_module(*target->machine);
    for (const NamedKernel& function : content.functions) {
        const KernelShape shape = shape_for(function.kernel, stencil, target->lanes);
        auto added = add_kernel(code, function.kernel, shape, function.name, *target->machine);
        if (!added) return tl::unexpected(added.error());
    }
    for (const NamedNumbers& numbers : content.numbers) add_numbers(code, numbers);
    const auto bytes = generate(code, *target->machine, CodeForm::object);
    if (!bytes) return tl::unexpected(bytes.error());
    return std::vector<std::uint8_t>(bytes->begin(), bytes->end());
}

Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil,
                              const JitOptions& options) {
    const auto made = compile_for(kernel, stencil, "kernel", options);
    if (!made) return tl::unexpected(made.error());
    std::string text;
    llvm::raw_string_ostream stream(text);
    made->code.module->print(stream, nullptr);
    return stream.str();
}

Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options) {
    auto made = compile_for(kernel, stencil, "kernel", options);
    if (!made) return tl::unexpected(made.error());
    const auto text = generate(made->code, *made->target.machine, CodeForm::assembly);
    if (!text) return tl::unexpected(text.error());
    return std::string(text->begin(), text->end());
}

}  // namespace cascade::llvm_module
