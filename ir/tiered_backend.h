// Kernels that run at once and switch to native code when it is ready.
//
// Loading a code generator takes longer than a small run. So begin() returns an interpreted kernel.
// A thread of the backend compiles it, and later calls run native code. Both give the same bits, so
// results do not depend on the moment of the switch. A kernel that has been interpreted for about
// as long as compilation takes waits for its code, because further interpretation would only slow
// the compiler down.
#pragma once

#include "ir/backend.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace cascade {

/// Interpreting this number of cells takes about as long as compiling their kernel: both grow with
/// the number of operations. With twenty, a cell takes 4 ns and compiling about ten milliseconds.
inline constexpr std::int64_t cells_worth_compiling = 262144;

/// Wraps another backend, whose kernels compile() returns. Thread-safe. Kernels outlive the backend
/// in their last state.
class TieredBackend final : public Backend {
public:
    explicit TieredBackend(std::unique_ptr<Backend> native);
    /// Compiles waiting kernels that have been used enough, so that later processes find them.
    ~TieredBackend() override;
    TieredBackend(const TieredBackend&) = delete;
    TieredBackend& operator=(const TieredBackend&) = delete;

    std::string_view name() const override;
    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override;
    KernelPointer find(const CellKernel& kernel, Stencil stencil) override;
    /// For kernels that run too rarely to be worth compiling. Thread-safe.
    Backend& interpreter() const { return *interpreter_; }
    KernelCounts counts() const override;
    std::string code_identity() const override;

    /// When a kernel that is interpreted meanwhile is compiled.
    enum class When : std::uint8_t {
        now,        ///< It will run for long.
        when_used,  ///< Once it has run over `cells_worth_compiling` cells, fewer with links.
    };
    /// A kernel that can run now: the result of find(), or a kernel that is interpreted until it is
    /// compiled (Kernel::is_provisional), or for good if compilation fails (Kernel::refusal). After
    /// interpreting `cells_worth_compiling` cells, calls wait for code that is wanted. Kernels are
    /// compiled in the order of their begin().
    KernelPointer begin(const CellKernel& kernel, Stencil stencil, When when);
    /// Announces a kernel that will be begun or compiled later. It is compiled after all others.
    void expect(const CellKernel& kernel, Stencil stencil);
    /// Waits until all kernels that have been used enough by now are compiled or refused.
    void settle();
    /// Drops the waiting kernels, which then stay interpreted. Finishes the present one, because
    /// compilation cannot be interrupted.
    void abandon();

private:
    class Worker;
    std::unique_ptr<Backend> native_;
    std::unique_ptr<Backend> interpreter_;
    std::shared_ptr<Worker> worker_;
};

}  // namespace cascade
