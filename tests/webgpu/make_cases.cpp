// Writes the cases of tests/webgpu_test.sh: random kernels with hostile inputs, and the first steps
// of systems of the library, of random scripts and of scripts with sides, noise and masks.
//
//   webgpu_cases sample|all FILE
#include "lang/library/library.h"
#include "tests/agreement/random_scripts.h"
#include "tests/agreement/script_outcome.h"
#include "tests/support/new_seed.h"
#include "tests/support/random_kernels.h"
#include "tests/webgpu/webgpu_case.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::test {
namespace {

/// How much is tried.
struct Amount {
    /// Kernels at each place, with fixed seeds, and their instructions.
    int first_kernels, operations;
    std::uint64_t kernels;  ///< Kernels at each place, with new seeds.
    std::uint64_t every;    ///< One system in so many of the library is recorded.
    std::uint64_t scripts;  ///< The number of random scripts.
};
constexpr Amount small_amount{1, 250, 2, 19, 2}, large_amount{4, 250, 60, 1, 60};

/// Names of operations that no kernel had on grids, and on linked cells. multiply_add may be
/// missing where the processor has none.
std::string never_tried(const OperationCounts& on_grids, const OperationCounts& on_links) {
    const auto of = [](const std::string& missing) {
        return missing == "multiply_add" && !has_multiply_add() ? "" : missing;
    };
    return of(on_grids.missing()) + of(on_links.missing(true, false));
}

std::string add_kernels(CaseFile& file, const Amount& amount) {
    Grid linked{37, 4};
    linked.linked = true;
    const std::vector<Grid> grids{
        {50, 1}, {1, 40}, {67, 5, Boundary::periodic}, {35, 4, Boundary::no_flux, 3}, linked};
    OperationCounts on_grids, on_links;
    std::uint64_t seed = 1;
    const auto kernel = [&](const Grid& grid, int operations) {
        RandomKernelOptions options;
        options.links = grid.linked;
        options.link_planes = false;  // All planes of a case have one size.
        options.operations = operations;
        // With more results, fewer operations are removed as unused.
        options.results = 1 + operations / 5;
        options.composed_percent = seed % 4 == 0 ? 4 : 0;
        CellKernel made = random_kernel(seed++, options);
        (grid.linked ? on_links : on_grids).add(made);
        return made;
    };
    const auto add = [&](const std::vector<CellKernel>& kernels, const Grid& grid,
                         Flushing flushing) {
        const std::string name = fmt::format(
            "{} random kernels before seed {} on {} × {} × {}{}, {}", kernels.size(), seed,
            grid.width, grid.height, grid.depth, grid.linked ? " linked cells" : "",
            flushing == Flushing::by_device ? "flushed by the device" : "flushed by kernels");
        case_of_kernels(kernels, grid, flushing, seed, name).write(file);
    };
    for (int turn = 0; turn < 2; ++turn) {
        for (const Grid& grid : grids) {
            for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
                // The links of a case belong to one kernel.
                const std::uint64_t of_program = grid.linked ? 1 : 20;
                const std::uint64_t count =
                    turn == 0
                        ? static_cast<std::uint64_t>(amount.first_kernels) * (grid.linked ? 4 : 1)
                        : amount.kernels;
                std::vector<CellKernel> kernels;
                for (std::uint64_t k = 0; k < count; ++k) {
                    kernels.push_back(kernel(grid, turn == 0 ? amount.operations : 40));
                    if (kernels.size() < of_program && k + 1 < count) continue;
                    add(kernels, grid, flushing);
                    kernels.clear();
                }
            }
        }
        if (turn == 0) seed = new_seed() + 1000;
    }
    return never_tried(on_grids, on_links);
}

class Scripts {
public:
    explicit Scripts(CaseFile& file) : file_(file) {}

    void add(const std::string& name, const std::string& text, const Overrides& overrides) {
        const auto recorded = std::make_shared<RecordedStages>();
        const auto flushing = ++tried % 2 == 0 ? Flushing::by_device : Flushing::by_kernel;
        SimulationOptions options{"interp", 0, 1};
        options.executor = recording_executor(file_, flushing, name, recorded);
        run_script(name, text, overrides, options, 12);
        taken += recorded->cases > 0;
        for (const std::string& reason : recorded->reasons) reasons[reason].push_back(name);
    }

    int tried = 0, taken = 0;
    std::map<std::string, std::vector<std::string>> reasons;

private:
    CaseFile& file_;
};

std::string script_of(const std::string& domain, const std::string& rules,
                      const std::string& settings) {
    return fmt::format("domain {{ {} }}\nsystem s {{\n{}\n}}\nstage only: s {{ {} }}\n", domain,
                       rules, settings);
}

void add_chosen(Scripts& scripts) {
    const std::string spots =
        "u: 1 - 0.5 * disc(0.5, 0.5, 0.2)\nv: 0.25 * disc(0.5, 0.5, 0.2) + random(0.01, 0.01)\n"
        "rate = u * v^2\nu' = 0.16 * lap(u) - rate + 0.037 * (1 - u)\n"
        "v' = 0.08 * lap(v) + rate - 0.097 * v";
    const std::string tide =
        "u: 0\nv: 0\nu' = lap(u) + v\nv' = lap(v) - u\nu.left: fixed(sin(t / 10) * sy)\n"
        "u.right: slope(-0.1)\nv.top: fixed(sx)\nv.bottom: slope(0.2 * t)";
    const std::string noise =
        "u: noise(0.3)\nv: 1\nu' = 0.2 * lap(u) + normal(0, 0.1)\n"
        "v' = 0.1 * div(u * grad(v)) + 0.01 * sqrt(abs(u) + 1) * step";
    const std::string steps = "iterations: 12";
    const auto add = [&](const std::string& text) { scripts.add("script:\n" + text, text, {}); };
    add(script_of("grid: 60, 1; boundary: noflux", spots, steps));
    add(script_of("grid: 12, 9, 7; boundary: noflux, periodic, noflux", spots, steps));
    add(script_of("surface: sphere; cells: 300", spots, steps));
    add(script_of("grid: 20, 11", spots, steps + "; solver: rk4"));
    add(script_of("grid: 20, 11", spots, steps + "; solver: rkl2; speed: 2"));
    add(script_of("grid: 32, 16; boundary: noflux", tide, steps + "; speed: 0.2; solver: rk4"));
    add(script_of("grid: 9, 8, 5; boundary: noflux; front: fixed(1)", tide,
                  steps + "; speed: 0.1"));
    add(script_of("grid: 37, 19; boundary: noflux; mask: disc(0.5, 0.5, 0.4)", noise, steps));
}

/// Systems of the library that need an aggregate, a constraint and a convolution.
const std::set<std::string> not_on_webgpu{"lightning", "vortices", "young"};

/// Adds scripts, and returns whether everything that WebGPU can compute was recorded.
bool add_scripts(CaseFile& file, const Amount& amount) {
    Scripts chosen(file), library(file), random(file);
    add_chosen(chosen);
    const auto texts = library_texts();
    for (std::uint64_t k = new_seed() % amount.every; k < texts.size(); k += amount.every) {
        Overrides overrides;
        overrides.steps = 12;
        overrides.grid = GridSize{36, 29, 1};
        library.add(std::string(texts[k].system_name()), std::string(texts[k].text), overrides);
    }
    for (std::uint64_t seed = new_seed(); seed < new_seed() + amount.scripts; ++seed) {
        random.add(fmt::format("random script {}", seed), random_script(seed), {});
    }
    std::printf("systems of the library: %d of %d\n", library.taken, library.tried);
    std::set<std::string> refused;
    for (const auto& [reason, names] : library.reasons) {
        refused.insert(names.begin(), names.end());
        std::printf("  not on WebGPU, because %s: %s\n", reason.c_str(),
                    fmt::format("{}", fmt::join(names, ", ")).c_str());
    }
    std::printf("random scripts: %d of %d\n", random.taken, random.tried);
    const bool is_known = amount.every > 1 || refused == not_on_webgpu;
    return is_known && chosen.taken == chosen.tried &&
           library.taken + static_cast<int>(refused.size()) == library.tried;
}

bool make_cases(const Amount& amount, const std::string& path) {
    CaseFile file(path);
    for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
        probing_case(flushing).write(file);
    }
    const std::string missing = add_kernels(file, amount);
    if (!missing.empty()) std::printf("operations that were never tried: %s\n", missing.c_str());
    const bool are_enough = add_scripts(file, amount);
    if (!are_enough) std::printf("other scripts were recorded than expected\n");
    std::printf("%d cases\n", file.cases);
    return missing.empty() && are_enough;
}

}  // namespace
}  // namespace cascade::test

int main(int count, char** arguments) {
    const std::string_view mode = count == 3 ? arguments[1] : "";
    if (mode != "sample" && mode != "all") {
        std::fprintf(stderr, "usage: webgpu_cases sample|all FILE\n");
        return 64;
    }
    using namespace cascade::test;
    return make_cases(mode == "all" ? large_amount : small_amount, arguments[2]) ? 0 : 1;
}
