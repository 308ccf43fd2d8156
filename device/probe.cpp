// Computes each operation on pairs of difficult words, by a printed kernel and by the interpreter,
// and compares the results.
#include "device/probe.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "device/build_options.h"
#include "device/kernel_text.h"
#include "device/probed_kernel.h"
#include "ir/interpreter.h"

#include <fmt/format.h>

#include <bit>
#include <span>
#include <vector>

namespace cascade {
namespace {

template <typename Number>
class Probe {
    using Word = WordOf<Number>;

public:
    Probe(OpenDevice& device, const TextTarget& target)
        : device_(device), target_(target), layout_(grid_) {}

    /// Describes the first difference. Empty if all results agree.
    std::string fault() {
        std::vector<Plane<Number>> given = probed_.arguments();
        const DeviceProgram built =
            device_.build(text(given.size()), build_options(target_, device_.facts()));
        const std::size_t bytes = Plane<Number>::bytes(layout_);
        const DeviceBuffer planes = device_.buffer(bytes * (given.size() + kernel_.results.size()));
        for (std::size_t k = 0; k < given.size(); ++k) {
            device_.write(planes, bytes * k, memory_of(given[k]), bytes);
        }
        DeviceKernel run = built.kernel("c_probe");
        const auto columns = static_cast<std::size_t>((layout_.width + 15) / 16 * 16);
        const auto rows = static_cast<std::int32_t>(layout_.height);
        run.set(planes, Word{0}, std::int32_t{0}, rows);
        device_.launch(run, columns, static_cast<std::size_t>(rows), 16);
        const std::vector<Plane<Number>> expected = interpreted();
        for (std::size_t k = 0; k < expected.size(); ++k) {
            Plane<Number> found(layout_);
            device_.read(planes, bytes * (given.size() + k), memory_of(found), bytes);
            const std::string fault = probed_.difference(k, expected[k], found);
            if (!fault.empty()) return fault;
        }
        return "";
    }

private:
    Number* memory_of(Plane<Number>& plane) const { return plane.origin() - layout_.offset(0, 0); }

    std::string text(std::size_t fields) const {
        KernelNames names;
        std::int64_t place = layout_.offset(0, 0);
        const auto plane = [&] {
            const std::string name = fmt::format("c_planes + {}", place);
            place += layout_.size();
            return name;
        };
        for (std::size_t k = 0; k < fields; ++k) names.fields.push_back(plane());
        for (std::size_t k = 0; k < kernel_.results.size(); ++k) names.results.push_back(plane());
        const Stencil stencil = grid_.stencil();
        return prelude_text(target_) + stencil_text(target_, stencil, layout_) +
               "__kernel void c_probe(__global cw* c_planes, const cw c_pad, "
               "const int c_first_row, const int c_last_row) {\n" +
               cells_begin(target_, stencil, layout_, 1) +
               cell_text(kernel_, names, target_, stencil, layout_) + std::string(cells_end) +
               "}\n";
    }

    std::vector<Plane<Number>> interpreted() const {
        const FlushDenormals environment;
        return probed_.results_of(*make_interpreter()->find(kernel_, grid_.stencil()));
    }

    OpenDevice& device_;
    TextTarget target_;
    ProbedKernel<Number> probed_;
    const CellKernel& kernel_ = probed_.kernel;
    const Grid& grid_ = probed_.grid;
    PlaneLayout layout_;
};

}  // namespace

ProbeResult probe(OpenDevice& device, Precision precision) {
    ProbeResult result;
    result.target.precision = precision;
    result.target.has_fast_fma = device.facts().has_fast_fma;
    if (precision == Precision::binary64 && !device.facts().has_double) {
        result.fault = "it has no double precision";
        return result;
    }
    for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
        result.target.flushing = flushing;
        result.fault = with_number(precision, [&](auto zero) {
            return Probe<decltype(zero)>(device, result.target).fault();
        });
        if (result.is_exact()) return result;
    }
    return result;
}

}  // namespace cascade
