// Prints one program for each stage, in which each pass is a kernel.
#include "app/wgsl_dump.h"

#include "device/wgsl_kernels.h"
#include "lang/lower/lower.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

namespace cascade {
namespace {

/// Lists the planes of a kernel by number and name.
std::string planes_of(const CellKernel& kernel, std::size_t first) {
    std::string fields, results;
    for (const std::string& name : kernel.field_names) {
        fields += fmt::format(" {} {}", first++, name);
    }
    for (const std::string& name : kernel.result_names) {
        results += fmt::format(" {} {}", first++, name);
    }
    return fmt::format("reads the planes{}; writes{}", fields, results);
}

}  // namespace

Result<std::string> dump_wgsl(const Program& program) {
    if (program.domain.precision != Precision::single) {
        return failure("WGSL has no double precision", "--precision single");
    }
    if (program.domain.grid.linked) {
        return failure(
            "WGSL is printed for lines, planes and volumes, not for the cells of a surface",
            "--dump ir shows the kernels of any domain");
    }
    std::string text;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const StepPlan plan = plan_step(program, k, {Materialise::when_cheaper, false, true});
        std::vector<const CellKernel*> kernels;
        for (const auto& pass : plan.passes) kernels.push_back(pass.bound.kernel.get());
        const WgslKernels made = wgsl_kernels(kernels, program.domain.grid, Flushing::by_kernel);
        text += fmt::format("// stage '{}': one step of Euler's method\n", program.stages[k].name);
        for (std::size_t pass = 0; pass < kernels.size(); ++pass) {
            text += fmt::format("// c_kernel_{} {}\n", pass,
                                planes_of(*kernels[pass], made.places[pass].plane));
        }
        text += made.text + "\n";
    }
    return text;
}

}  // namespace cascade
