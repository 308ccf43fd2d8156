// Kernels as object files, and as text for people to read.
#include "jit/code.h"
#include "jit/jit.h"
#include "jit/target_machine.h"

#include <llvm/Support/raw_ostream.h>

#include <algorithm>

namespace cascade {
namespace {

/// Code of one kernel together with the machine it is for.
struct Compiled {
    TargetChoice target;
    CodeModule code;
};

Result<Compiled> compile_for(const CellKernel& kernel, Stencil stencil, const std::string& name,
                             const std::string& cpu, const JitOptions& options) {
    auto target = choose_target(cpu, options);
    if (!target) return tl::unexpected(target.error());
    auto code = make_code(kernel, {stencil, target->lanes}, name, *target->machine);
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

}  // namespace

Result<std::vector<std::uint8_t>> compile_object(const CellKernel& kernel, Stencil stencil,
                                                 const ObjectOptions& options) {
    if (!is_c_identifier(options.function_name)) {
        return failure("'" + options.function_name + "' is not a name of C",
                       "letters, digits and '_', no digit in front");
    }
    auto made = compile_for(kernel, stencil, options.function_name, options.target, {});
    if (!made) return tl::unexpected(made.error());
    const auto bytes = generate(made->code, *made->target.machine, CodeForm::object);
    if (!bytes) return tl::unexpected(bytes.error());
    return std::vector<std::uint8_t>(bytes->begin(), bytes->end());
}

Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil,
                              const JitOptions& options) {
    const auto made = compile_for(kernel, stencil, "kernel", "", options);
    if (!made) return tl::unexpected(made.error());
    std::string text;
    llvm::raw_string_ostream stream(text);
    made->code.module->print(stream, nullptr);
    return stream.str();
}

Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options) {
    auto made = compile_for(kernel, stencil, "kernel", "", options);
    if (!made) return tl::unexpected(made.error());
    const auto text = generate(made->code, *made->target.machine, CodeForm::assembly);
    if (!text) return tl::unexpected(text.error());
    return std::string(text->begin(), text->end());
}

}  // namespace cascade
