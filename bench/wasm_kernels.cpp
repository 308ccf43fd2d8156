// cascade_wasm_bench: kernels of steps as WebAssembly modules in node, compared with native code,
// which has vectors of 4 cells here, as WebAssembly does.
//
//   cascade_wasm_bench [SYSTEM…]    of the library; by default gray_scott turing_spots stripes
//
// One core, 256² cells. Both sides take turns. Speeds are in millions of cells per second, medians
// of nine turns.
#include "core/floating_point.h"
#include "core/plane.h"
#include "jit/jit.h"
#include "lang/lower/lower.h"
#include "run/script/script.h"
#include "wasm/kernel_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

constexpr std::int64_t side = 256;
constexpr int turns = 9;

CellKernel step_of(const std::string& system) {
    const Script script =
        load_script(system,
                    fmt::format("domain {{ grid: {}, {} }}\nstage s: {} {{ }}", side, side, system),
                    "");
    if (!script.program) {
        std::fprintf(stderr, "%s", script.messages(false).c_str());
        std::exit(1);
    }
    const PlanOptions as_run{Materialise::when_cheaper, false, true};
    return *plan_step(*script.program, 0, as_run).passes.front().bound.kernel;
}

/// Measures how many seconds a call takes on planes with the same value in all cells. Calls repeat
/// for half a second, and the fastest counts.
class Native {
public:
    explicit Native(const CellKernel& kernel)
        : backend_(make_jit({4})),
          kernel_((*backend_)->compile(kernel, Stencil::plane)),
          uniforms_(kernel.uniform_names.size(), 0.25f),
          mask_(layout_) {
        for (std::size_t k = 0; k < kernel.field_names.size() + kernel.results.size(); ++k) {
            Plane<float>& plane = planes_.emplace_back(layout_);
            std::fill_n(plane.origin() - layout_.offset(0, 0), layout_.size(), 0.5f);
            if (k < kernel.field_names.size()) {
                fields_.push_back(plane.origin());
            } else {
                results_.push_back(plane.origin());
            }
        }
        masks_.assign(kernel.mask_names.size(), mask_.origin());
    }

    double seconds() const {
        using Clock = std::chrono::steady_clock;
        const FlushDenormals environment;
        constexpr int calls = 100;
        double least = 1;
        for (const auto end = Clock::now() + std::chrono::milliseconds(500); Clock::now() < end;) {
            const auto before = Clock::now();
            for (int k = 0; k < calls; ++k) {
                (*kernel_)->run({fields_, masks_, uniforms_, results_, layout_, {}, true},
                                {{0, side}});
            }
            const std::chrono::duration<double> taken = Clock::now() - before;
            least = std::min(least, taken.count() / calls);
        }
        return least;
    }

private:
    PlaneLayout layout_{Grid{side, side}};
    Result<std::unique_ptr<Backend>> backend_;
    Result<KernelPointer> kernel_;
    std::vector<Plane<float>> planes_;
    std::vector<float> uniforms_;
    Mask mask_;
    std::vector<const float*> fields_;
    std::vector<float*> results_;
    std::vector<const std::uint8_t*> masks_;
};

double seconds_in_node(const CellKernel& kernel, const std::string& file) {
    const std::string command =
        fmt::format("node {}/bench/wasm_kernels.mjs {} {} {} {} {} {} {} {}", CASCADE_SOURCE_DIR,
                    file, side, side, PlaneLayout(Grid{side, side}).stride,
                    kernel.field_names.size(), kernel.mask_names.size(),
                    kernel.uniform_names.size(), kernel.results.size());
    std::FILE* pipe = popen(command.c_str(), "r");
    double seconds = 0;
    if (!pipe || std::fscanf(pipe, "%lf", &seconds) != 1) {
        std::fprintf(stderr, "this did not work: %s\n", command.c_str());
        std::exit(1);
    }
    pclose(pipe);
    return seconds;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + turns / 2, values.end());
    return values[turns / 2];
}

void compare(const std::string& system) {
    const CellKernel kernel = step_of(system);
    const auto module = wasm_module(kernel, Stencil::plane);
    if (!module) std::exit(1);
    const std::string file = system + ".wasm";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(module->data()),
               static_cast<std::streamsize>(module->size()));
    const Native native(kernel);
    std::vector<double> ours, theirs;
    for (int turn = 0; turn < turns; ++turn) {
        theirs.push_back(native.seconds());
        ours.push_back(seconds_in_node(kernel, file));
    }
    const double millions = double{side} * side / 1e6;
    fmt::print("{:24} {:6.0f} {:6.0f} {:6.2f}\n", system, millions / median(theirs),
               millions / median(ours), median(theirs) / median(ours));
}

}  // namespace
}  // namespace cascade::bench

int main(int count, char** arguments) {
    std::vector<std::string> systems(arguments + 1, arguments + count);
    if (systems.empty()) systems = {"gray_scott", "turing_spots", "stripes"};
    fmt::print("{:24} native   node  ratio\n", "");
    for (const std::string& system : systems) cascade::bench::compare(system);
}
