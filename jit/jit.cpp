// The backend: compiles, keeps what it compiled, and hands out kernels.
#include "jit/jit.h"

#include "core/check.h"
#include "jit/code.h"
#include "jit/native_session.h"
#include "jit/target_machine.h"

#include <fmt/format.h>
#include <llvm/Config/llvm-config.h>

#include <algorithm>
#include <mutex>
#include <unordered_map>

namespace cascade {
namespace {

template <typename Number>
class NativeKernel final : public Kernel {
public:
    NativeKernel(const CellKernel& kernel, Stencil stencil, std::unique_ptr<LoadedFunction> function)
        : stencil_(stencil),
          fields_(kernel.field_names.size()),
          masks_(kernel.mask_names.size()),
          uniforms_(kernel.uniform_names.size()),
          results_(kernel.results.size()),
          function_(std::move(function)) {
        for (const Instruction& instruction : kernel.code) {
            const Op op = instruction.op;
            has_link_sums_ |= stencil.links && is_link_sum(op);
            has_gradients_ |= op >= Op::gradient_x && op <= Op::gradient_z;
        }
    }

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& arguments, RowRange rows) const override {
        CHECK(arguments.fields.size() >= fields_ && arguments.masks.size() >= masks_ &&
                  arguments.uniforms.size() >= uniforms_ && arguments.results.size() >= results_,
              "a kernel is given all its planes and numbers");
        CHECK(rows.empty() || (rows.begin >= 0 && rows.end <= arguments.layout.row_count()),
              "rows to compute are rows of the plane");
        const PlaneLayout& layout = arguments.layout;
        if (layout.width <= 0) return;
        CHECK(stencil_.z == (layout.depth > 1), "a kernel runs on grids of its stencil");
        if (stencil_.z) return run_slices(arguments, rows);
        if (stencil_.links) return run_linked(arguments, rows);
        function_->template as<GridFunction<Number>>()(
            arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
            arguments.results.data(), layout.width, layout.stride, rows.begin, rows.end);
    }

private:
    /// One call for each slice that has some of the rows.
    void run_slices(const KernelArgumentsOf<Number>& arguments, RowRange rows) const {
        const PlaneLayout& layout = arguments.layout;
        while (!rows.empty()) {
            const std::int64_t slice = rows.begin / layout.height;
            const std::int64_t end = std::min(rows.end, (slice + 1) * layout.height);
            // From numbers through the cells to numbers of rows in memory.
            const std::int64_t halo_rows = slice * (layout.slice_rows() - layout.height);
            function_->template as<VolumeFunction<Number>>()(
                arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
                arguments.results.data(), layout.width, layout.stride, rows.begin + halo_rows,
                end + halo_rows, layout.slice_rows(), slice);
            rows.begin = end;
        }
    }

    void run_linked(const KernelArgumentsOf<Number>& arguments, RowRange rows) const {
        const PlaneLayout& layout = arguments.layout;
        const LinkTable<Number>& links = arguments.links;
        CHECK(!has_link_sums_ || links.starts, "a kernel that sums over links is given them");
        CHECK(!has_gradients_ || links.gradients[2], "and gradients, where it asks for them");
        function_->template as<LinkedFunction<Number>>()(
            arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
            arguments.results.data(), layout.width, layout.stride, rows.begin, rows.end,
            links.starts, links.targets, links.weights, links.gradients[0], links.gradients[1],
            links.gradients[2]);
    }

    Stencil stencil_;
    std::size_t fields_, masks_, uniforms_, results_;
    bool has_link_sums_ = false, has_gradients_ = false;
    std::unique_ptr<LoadedFunction> function_;
};

/// A kernel that was compiled, with all that its code depends on: hashes may collide.
struct Known {
    CellKernel kernel;
    Stencil stencil;
    KernelPointer compiled;

    bool is(const CellKernel& other, Stencil its_stencil) const {
        return stencil == its_stencil && kernel.precision == other.precision &&
               kernel.code == other.code &&
               kernel.results == other.results &&
               kernel.field_names.size() == other.field_names.size() &&
               kernel.mask_names.size() == other.mask_names.size() &&
               kernel.uniform_names.size() == other.uniform_names.size();
    }
};

/// Beyond this many kernels all are forgotten, so that a day at the prompt does not fill memory;
/// those that somebody holds live on.
constexpr std::size_t most_known = 1024;

class JitBackend final : public Backend {
public:
    JitBackend(std::unique_ptr<llvm::TargetMachine> machine,
               std::shared_ptr<NativeSession> session, int lanes)
        : machine_(std::move(machine)), session_(std::move(session)), lanes_(lanes) {}

    std::string_view name() const override { return "jit"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        const std::lock_guard lock(mutex_);
        const std::uint64_t key = hash(kernel) * 16 + stencil.number();
        const auto [first, last] = known_.equal_range(key);
        for (auto found = first; found != last; ++found) {
            if (found->second.is(kernel, stencil)) return found->second.compiled;
        }
        Result<KernelPointer> made = make(kernel, stencil);
        if (!made) return made;
        if (known_.size() >= most_known) known_.clear();
        known_.emplace(key, Known{kernel, stencil, *made});
        return made;
    }

private:
    Result<KernelPointer> make(const CellKernel& kernel, Stencil stencil) {
        const std::string function_name = fmt::format("kernel{}", next_number_++);
        const KernelShape shape = shape_for(kernel, stencil, *machine_, lanes_);
        auto code = make_code(kernel, shape, function_name, *machine_);
        if (!code) return tl::unexpected(code.error());
        const auto object = generate(*code, *machine_, CodeForm::object);
        if (!object) return tl::unexpected(object.error());
        auto function = session_->load({object->data(), object->size()}, function_name);
        if (!function) return tl::unexpected(function.error());
        return with_number(kernel.precision, [&](auto zero) -> KernelPointer {
            return std::make_shared<NativeKernel<decltype(zero)>>(kernel, stencil,
                                                                  std::move(*function));
        });
    }

    std::mutex mutex_;
    std::unique_ptr<llvm::TargetMachine> machine_;
    std::shared_ptr<NativeSession> session_;
    int lanes_;
    std::uint64_t next_number_ = 0;
    std::unordered_multimap<std::uint64_t, Known> known_;
};

}  // namespace

Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options) {
    auto target = choose_target("", options);
    if (!target) return tl::unexpected(target.error());
    auto session = NativeSession::make();
    if (!session) return tl::unexpected(session.error());
    return std::make_unique<JitBackend>(std::move(target->machine), std::move(*session),
                                        target->lanes);
}

std::string describe_jit() {
    const auto target = choose_target("", {});
    if (!target) return fmt::format("LLVM {}: {}", LLVM_VERSION_STRING, target.error().message);
    return fmt::format("LLVM {}, {}, {} cells a vector", LLVM_VERSION_STRING, host_cpu_name(),
                       target->lanes);
}

}  // namespace cascade
