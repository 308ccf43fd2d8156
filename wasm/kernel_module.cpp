// Writes the loops over rows and cells, and the sections of the module (WebAssembly Core
// Specification 2.0, section 5.5).
#include "wasm/kernel_module.h"

#include "ir/multiply_add.h"
#include "wasm/body.h"

namespace cascade {
namespace wasm {
namespace {

constexpr std::size_t most_instructions = 20000;

/// The number of vectors computed in one pass of the loop. It is two for small kernels, so that the
/// loop counter and addresses take little time. Kernels may write this many vectors behind the last
/// cell of a row.
int vectors_of_group(const CellKernel& kernel) {
    constexpr std::size_t largest_in_pairs = 64;
    return kernel.code.size() <= largest_in_pairs ? 2 : 1;
}

std::uint32_t parameter_count(Stencil stencil) {
    return static_cast<std::uint32_t>(stencil.links ? Parameter::linked_parameters
                                      : stencil.z   ? Parameter::volume_parameters
                                                    : Parameter::plane_parameters);
}

/// Pushes the distance in bytes from the plane's first cell to a column of the present row.
void push_place(Code& code, const Function& function, Local row, Parameter column) {
    code.get(row);
    code.get(local_of(column));
    code.integer(function.number_shift());
    code.write(Plain::shift_left);
    code.write(Plain::add);
}

/// Copies columns to the halo of a row, if the arguments name columns.
void write_columns(Code& code, Cells& cells, const std::vector<std::size_t>& results,
                   Local row_end) {
    code.open(Plain::block);
    code.get(local_of(Parameter::left_column));
    code.integer(0);
    code.write(Plain::less);
    code.branch_if();
    for (const std::size_t result : results) cells.fill_columns(code, result, row_end);
    code.close();
}

/// Ends a loop: adds `step` to `counter`, and begins anew while `counter` is `less` than `end`.
void close_loop(Code& code, Local counter, int step, Local end, Plain less) {
    code.get(counter);
    code.integer(step);
    code.write(Plain::add);
    code.tee(counter);
    code.get(end);
    code.write(less);
    code.branch_if();
    code.close();
}

/// The function of a part of a kernel: its loops and their bodies.
Bytes function_of(const KernelPart& part, Stencil stencil, bool is_exact) {
    const CellKernel& kernel = part.kernel;
    Function function(kernel.precision, parameter_count(stencil));
    const auto integer = [&] { return function.take(LoopLevel::row, LocalType::integer); };
    const Place place{integer(), integer()};
    const Local end = integer(), row = local_of(Parameter::row_begin);
    const auto cells = stencil.links ? make_linked_cells(function, kernel, place, is_exact)
                                     : make_grid_cells(function, kernel, stencil, place, is_exact);
    Body body(part, function, *cells, is_exact);
    body.write(LoopLevel::call);
    body.write(LoopLevel::row);
    const int vectors = vectors_of_group(kernel);
    cells->begin_group(vectors);
    for (int vector = 0; vector < vectors; ++vector) {
        cells->begin_vector(vector);
        body.write(LoopLevel::cell);
        cells->end_vector();
    }

    Code code(kernel.precision);
    code.write(function.at(LoopLevel::call));
    code.open(Plain::block);
    code.get(row);
    code.get(local_of(Parameter::row_end));
    code.write(Plain::greater_equal);
    code.branch_if();
    code.open(Plain::loop);
    code.get(row);
    code.get(local_of(Parameter::stride));
    code.write(Plain::multiply);
    code.integer(function.number_shift());
    code.write(Plain::shift_left);
    code.set(place.row);
    push_place(code, function, place.row, Parameter::column_begin);
    code.set(place.group);
    push_place(code, function, place.row, Parameter::column_end);
    code.set(end);
    code.write(function.at(LoopLevel::row));
    code.open(Plain::loop);
    code.write(function.at(LoopLevel::cell));
    close_loop(code, place.group, vectors * Code::vector_bytes, end, Plain::less_unsigned);
    if (!stencil.links && !stencil.z) write_columns(code, *cells, part.results, end);
    close_loop(code, row, 1, local_of(Parameter::row_end), Plain::less);
    code.close();
    code.close();  // Closes the function.
    return function.with_locals(code);
}

enum class Section : std::uint8_t {
    types = 1,
    imports = 2,
    functions = 3,
    exports = 7,
    codes = 10
};

void append_section(Bytes& to, Section section, const std::vector<Bytes>& entries) {
    Bytes content;
    append_unsigned(content, entries.size());
    for (const Bytes& entry : entries) append(content, entry);
    to.push_back(static_cast<std::uint8_t>(section));
    append_sized(to, content);
}

/// A function that calls all other functions in order and passes its own arguments to each.
Bytes calls_of(std::size_t functions, std::uint32_t parameters) {
    Code code(Precision::single);
    for (std::size_t function = 0; function < functions; ++function) {
        for (std::uint32_t k = 0; k < parameters; ++k) code.get(Local(k));
        code.call(function);
    }
    code.close();
    Bytes function;
    append_unsigned(function, 0);  // No locals.
    append(function, code.bytes());
    return function;
}

/// A module that imports the memory of its host and contains functions with the same parameters. It
/// exports the last one.
Bytes module_of(const std::vector<Bytes>& functions, std::uint32_t parameters) {
    constexpr std::uint8_t function_type = 0x60, is_function = 0x00, is_memory = 0x02;
    Bytes type{function_type};
    append_sized(type, Bytes(parameters, static_cast<std::uint8_t>(LocalType::integer)));
    type.push_back(0);  // No results.
    Bytes memory;
    append_name(memory, "env");
    append_name(memory, "memory");
    append(memory, {is_memory, 0, 0});  // With at least 0 pages.
    Bytes exported;
    append_name(exported, "run");
    exported.push_back(is_function);
    append_unsigned(exported, functions.size() - 1);
    std::vector<Bytes> codes;
    for (const Bytes& function : functions) append_sized(codes.emplace_back(), function);

    Bytes module{0, 'a', 's', 'm', 1, 0, 0, 0};
    append_section(module, Section::types, {type});
    append_section(module, Section::imports, {memory});
    append_section(module, Section::functions, std::vector<Bytes>(functions.size(), {0}));
    append_section(module, Section::exports, {exported});
    append_section(module, Section::codes, codes);
    return module;
}

}  // namespace
}  // namespace wasm

Result<std::vector<std::uint8_t>> wasm_module(const CellKernel& kernel, Stencil stencil,
                                              const WasmOptions& options) {
    if (multiplies_and_adds(kernel)) return failure("WebAssembly has no multiply-add");
    if (kernel.code.size() > wasm::most_instructions) {
        return failure("the kernel is too large to be compiled");
    }
    const std::uint32_t parameters = wasm::parameter_count(stencil);
    std::vector<wasm::Bytes> functions;
    for (const KernelPart& part : parts_of(kernel)) {
        functions.push_back(wasm::function_of(part, stencil, options.is_exact));
    }
    if (functions.size() > 1) functions.push_back(wasm::calls_of(functions.size(), parameters));
    return wasm::module_of(functions, parameters);
}

}  // namespace cascade
