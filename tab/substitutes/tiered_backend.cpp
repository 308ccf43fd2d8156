// A tab has no threads, so a kernel is compiled when it is requested, which takes a browser
// milliseconds.
#include "ir/tiered_backend.h"

#include "tab/module_backend.h"

namespace cascade {

class TieredBackend::Worker {};

namespace {

/// A kernel that could not be compiled and is always interpreted.
class RefusedKernel final : public Kernel {
public:
    RefusedKernel(KernelPointer interpreted, Failure why)
        : interpreted_(std::move(interpreted)), why_(std::move(why)) {}
    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        interpreted_->run(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        interpreted_->run(arguments, cells);
    }
    const Failure* refusal() const override { return &why_; }

private:
    KernelPointer interpreted_;
    Failure why_;
};

}  // namespace

TieredBackend::TieredBackend(std::unique_ptr<Backend> native)
    : native_(std::move(native)), interpreter_(make_starting_backend()) {}
TieredBackend::~TieredBackend() = default;

std::string_view TieredBackend::name() const { return native_->name(); }
KernelCounts TieredBackend::counts() const { return native_->counts(); }
std::string TieredBackend::code_identity() const { return native_->code_identity(); }

Result<KernelPointer> TieredBackend::compile(const CellKernel& kernel, Stencil stencil) {
    return native_->compile(kernel, stencil);
}

KernelPointer TieredBackend::find(const CellKernel& kernel, Stencil stencil) {
    return native_->find(kernel, stencil);
}

KernelPointer TieredBackend::begin(const CellKernel& kernel, Stencil stencil, When) {
    auto compiled = compile(kernel, stencil);
    if (compiled) return *std::move(compiled);
    return std::make_shared<RefusedKernel>(*interpreter_->compile(kernel, stencil),
                                           compiled.error());
}

void TieredBackend::expect(const CellKernel&, Stencil) {}
void TieredBackend::settle() {}
void TieredBackend::abandon() {}

}  // namespace cascade
