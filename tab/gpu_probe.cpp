// Computes each operation on pairs of difficult words, on the GPU and by an exact module.
#include "tab/gpu_probe.h"

#include "core/plane.h"
#include "device/probed_kernel.h"
#include "device/wgsl_kernels.h"
#include "device/wgsl_prelude.h"
#include "tab/gpu_programs.h"
#include "tab/module_backend.h"

#include <vector>

namespace cascade {
namespace {

/// The results of the GPU. Empty if it fails.
std::vector<Field> results_of_gpu(const ProbedKernel<float>& probed, Flushing flushing) {
    const CellKernel* const kernels[] = {&probed.kernel};
    const WgslKernels printed = wgsl_kernels(kernels, probed.grid, flushing);
    const PlaneLayout layout(probed.grid);
    const auto size = static_cast<std::size_t>(layout.size());
    GpuPrograms programs(printed.text, "", first_call_word, {printed.end.plane * size, 0, 0, 0});
    if (!programs.is_made()) return {};
    const std::vector<Plane<float>> given = probed.arguments();
    for (std::size_t k = 0; k < given.size(); ++k) {
        programs.write(k * size, given[k].origin() - layout.offset(0, 0), size);
    }
    WgslCall call = call_of_plane(layout);
    call.words.resize(first_call_word);
    programs.add(0, call);
    std::vector<Field> results;
    for (std::size_t k = 0; k < probed.kernel.results.size(); ++k) results.emplace_back(layout);
    const bool is_done = programs.run({}) && programs.read(given.size() * size, results);
    return is_done ? std::move(results) : std::vector<Field>{};
}

/// Describes the first difference. Empty if there is none.
std::string fault_of(Flushing flushing) {
    const ProbedKernel<float> probed;
    const std::vector<Field> found = results_of_gpu(probed, flushing);
    if (found.empty()) return about_gpu();
    const auto kernel = make_exact_backend()->compile(probed.kernel, probed.grid.stencil());
    if (!kernel) return kernel.error().message;
    const std::vector<Plane<float>> expected = probed.results_of(**kernel);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const std::string fault = found[k].visit([&]<typename Number>(const Plane<Number>& plane) {
            if constexpr (std::is_same_v<Number, float>) {
                return probed.difference(k, expected[k], plane);
            } else {
                return std::string();
            }
        });
        if (!fault.empty()) return "the GPU is not bit-exact: " + fault;
    }
    return "";
}

GpuProbe probe_gpu() {
    GpuProbe probe;
    for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
        probe.fault = fault_of(flushing);
        if (!probe.fault.empty()) continue;
        probe.flushing = flushing;
        break;
    }
    return probe;
}

}  // namespace

const GpuProbe& probed_gpu() {
    static const GpuProbe probe = probe_gpu();
    return probe;
}

}  // namespace cascade
