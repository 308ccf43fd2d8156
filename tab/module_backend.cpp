// Calls the functions of WebAssembly modules with the planes of their kernels.
#include "tab/module_backend.h"

#include "ir/interpreter.h"
#include "ir/kernel_calls.h"
#include "tab/host.h"
#include "wasm/kernel_module.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace cascade {
namespace {

bool are_modules_exact = false;

/// The largest number of compiled kernels that are stored for reuse, including kernels of earlier
/// scripts.
constexpr std::size_t most_kept = 256;

// The type of a function with the arguments that all kernels have: fields, masks, uniforms,
// results, columns, stride, rows.
using Shared = void(const void*, const void*, const void*, const void*, std::int32_t, std::int32_t,
                    std::int32_t, std::int32_t, std::int32_t);
template <typename Function, typename... More>
struct Extended;
template <typename... First, typename... More>
struct Extended<void(First...), More...> {
    using Type = void(First..., More...);
};
using PlaneFunction = Extended<Shared, std::int32_t, std::int32_t>::Type;
using VolumeFunction = PlaneFunction;
using LinkedFunction = Extended<Shared, const void*, const void*, const void*, const void*,
                                const void*, const void*, const void*, const void*>::Type;

/// A function pointer. In WebAssembly it is an index in the engine's table of functions.
class ModuleFunction {
public:
    explicit ModuleFunction(std::uint32_t place) : place_(place) {}
    ~ModuleFunction() { host_drop_kernel(place_); }
    ModuleFunction(const ModuleFunction&) = delete;
    ModuleFunction& operator=(const ModuleFunction&) = delete;

    template <typename Function>
    Function* as() const {
        return reinterpret_cast<Function*>(place_);
    }

private:
    std::uint32_t place_;
};

std::int32_t word(std::int64_t number) { return static_cast<std::int32_t>(number); }

template <typename Number>
class ModuleKernel final : public Kernel {
public:
    ModuleKernel(Stencil stencil, std::uint32_t place) : stencil_(stencil), function_(place) {}

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& given, const Patch& cells) const override {
        const PlaneLayout& layout = given.layout;
        const ColumnRange columns = cells.columns.within(layout.width);
        if (columns.count() <= 0 || cells.rows.empty()) return;
        const auto call = [&](auto* function, RowRange rows, auto... more) {
            function(given.fields.data(), given.masks.data(), given.uniforms.data(),
                     given.results.data(), word(columns.begin), word(columns.end),
                     word(layout.stride), word(rows.begin), word(rows.end), more...);
        };
        if (stencil_.links) {
            const LinkTable<Number>& links = given.links;
            const auto& [x, y, z] = links.gradients;
            call(function_.as<LinkedFunction>(), cells.rows, static_cast<const void*>(links.starts),
                 static_cast<const void*>(links.bases), static_cast<const void*>(links.offsets),
                 static_cast<const void*>(links.weights), static_cast<const void*>(x),
                 static_cast<const void*>(y), static_cast<const void*>(z),
                 static_cast<const void*>(links.filled));
        } else if (stencil_.z) {
            for_each_slice(layout, cells.rows, [&](RowRange rows, std::int64_t slice) {
                call(function_.as<VolumeFunction>(), rows, word(layout.slice_rows()), word(slice));
            });
        } else {
            const HaloColumns filled = columns_to_fill(given, columns);
            call(function_.as<PlaneFunction>(), cells.rows, word(filled.left), word(filled.right));
        }
    }

    bool fills_columns() const override { return kernels_fill_columns(stencil_); }

private:
    Stencil stencil_;
    ModuleFunction function_;
};

class ModuleBackend final : public Backend {
public:
    explicit ModuleBackend(bool is_exact = false) : is_exact_(is_exact) {}

    std::string_view name() const override { return "wasm"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        auto module = wasm_module(kernel, stencil, {is_exact_ || are_modules_exact});
        if (!module) return tl::unexpected(module.error());
        if (kernels_.size() >= most_kept) {
            std::erase_if(kernels_,
                          [](const auto& kernel) { return kernel.second.use_count() <= 1; });
        }
        const std::string key(module->begin(), module->end());
        KernelPointer& known = kernels_[{key, stencil_number(stencil)}];
        if (known != nullptr) return known;
        const std::uint32_t place = host_add_kernel(module->data(), module->size());
        if (place == 0) return failure("the browser refused the code of a kernel");
        ++counts_.compiled;
        if (kernel.precision == Precision::single) {
            known = std::make_shared<ModuleKernel<float>>(stencil, place);
        } else {
            known = std::make_shared<ModuleKernel<double>>(stencil, place);
        }
        return known;
    }

    /// Always null, because compile() is fast: writing a module takes microseconds, and the browser
    /// compiles a module in milliseconds.
    KernelPointer find(const CellKernel&, Stencil) override { return nullptr; }

    KernelCounts counts() const override { return counts_; }

private:
    static int stencil_number(Stencil stencil) {
        return stencil.x + 2 * stencil.y + 4 * stencil.z + 8 * stencil.links;
    }

    bool is_exact_;
    std::map<std::pair<std::string, int>, KernelPointer> kernels_;
    KernelCounts counts_;
};

}  // namespace

void make_modules_exact() { are_modules_exact = true; }

std::unique_ptr<Backend> make_module_backend() { return std::make_unique<ModuleBackend>(); }

std::unique_ptr<Backend> make_exact_backend() { return std::make_unique<ModuleBackend>(true); }

std::unique_ptr<Backend> make_starting_backend() {
    return are_modules_exact ? make_module_backend() : make_interpreter();
}

}  // namespace cascade
