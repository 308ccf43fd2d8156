// Writes the cases of tests/wasm_agreement_test.sh: random kernels, and the kernels of the library,
// of all examples and of random scripts, with hostile inputs.
//
//   wasm_cases kept|exact FILE
#include "core/floating_point.h"
#include "ir/builder.h"
#include "lang/library/library.h"
#include "lang/lower/lower.h"
#include "run/script/script.h"
#include "solvers/scheme.h"
#include "tests/agreement/random_scripts.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/new_seed.h"
#include "tests/support/random_kernels.h"
#include "tests/wasm/recorded_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

/// A step of diffusing species, each of which consumes the next one.
CellKernel ring_of_species(std::size_t species, Precision precision) {
    KernelBuilder builder(precision);
    const auto slot = [&](std::size_t k) {
        return builder.field_slot(fmt::format("u{}", k % species));
    };
    for (std::size_t k = 0; k < species; ++k) {
        const ValueId food = builder.multiply(builder.field(slot(k)), builder.field(slot(k + 1)));
        builder.result(fmt::format("u{}", k), builder.add(food, builder.laplacian(slot(k))));
    }
    return std::move(builder).finish();
}

class Cases {
public:
    Cases(CaseFile& file, bool is_exact) : file_(file), is_exact_(is_exact) {}

    /// Adds a run of the kernel on all cells of a grid, and a run on some of the cells.
    void add(const CellKernel& kernel, const Grid& grid, std::uint64_t seed,
             const std::string& name) {
        const Recording recording{name, is_exact_, seed % 3 == 0};
        const auto recorded = recorded_kernel(kernel, grid.stencil(), recording, file_);
        HostileInputs inputs(kernel, grid, seed);
        const std::int64_t last = grid.width - 1;
        if (seed % 5 == 0)
            inputs.fill_columns(seed % 2 == 0 ? HaloColumns{last, 0} : HaloColumns{0, last});
        const std::int64_t rows = PlaneLayout(grid).row_count();
        inputs.run(*recorded);
        if (grid.linked || seed % 4 != 0) return;
        const std::int64_t first = 16 * (static_cast<std::int64_t>(seed / 4) % 3);
        if (first < grid.width) inputs.run(*recorded, {{rows / 3, rows}, {first, first + 16}});
    }

    void add_random(std::uint64_t first_seed, std::uint64_t count, Precision precision,
                    bool links) {
        for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
            RandomKernelOptions options;
            options.precision = precision;
            options.links = links;
            options.multiply_adds = false;
            options.operations = 6 + static_cast<int>(seed % 20);
            options.results = 1 + static_cast<int>(seed % 3);
            options.composed_percent = seed % 8 == 0 ? 8 : 0;
            const CellKernel kernel = random_kernel(seed, options);
            tried_.add(kernel);
            add(kernel, links ? random_linked_grid(seed, 67, 5) : random_grid(seed, 67, 5, 3), seed,
                fmt::format("random kernel {} of {}{}", seed, name_of(precision),
                            links ? ", linked" : ""));
        }
    }

    /// Adds the kernels of a script, except those that an earlier script had.
    void add_script(const Script& script) {
        const Program& program = *script.program;
        Grid cells_of_domain = program.domain.grid;
        cells_of_domain.width = std::min<std::int64_t>(cells_of_domain.width, 37);
        cells_of_domain.height = std::min<std::int64_t>(cells_of_domain.height, 3);
        cells_of_domain.depth = std::min<std::int64_t>(cells_of_domain.depth, 2);
        for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
            Grid grid = cells_of_domain;
            if (program.system_of(stage).cells) {
                grid.linked = true;
                grid.depth = 1;
            }
            const PlanOptions options{Materialise::when_cheaper, false, true};
            std::vector<StepPlan> plans{plan_uniform_start(program, stage),
                                        plan_start(program, stage),
                                        plan_step_invariants(program, stage, options),
                                        plan_step(program, stage, options),
                                        plan_rates(program, stage),
                                        plan_view(program, program.stages[stage].show, stage)};
            const std::uint32_t species = program.system_of(stage).species_count();
            for (const SweepForm& form : make_scheme(Solver::rkl2, species, false).forms) {
                plans.push_back(plan_sweep(program, stage, form, options));
            }
            for (const StepPlan& plan : plans) {
                for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
                    const CellKernel& kernel = *plan.passes[pass].bound.kernel;
                    const std::uint64_t key = 16 * hash(kernel) + grid.stencil().number();
                    if (kernel.results.empty() || !known_.insert(key).second) continue;
                    add(kernel, grid, known_.size(),
                        fmt::format("{}, stage {}, pass {}", script.name, stage + 1, pass + 1));
                }
            }
        }
    }

    /// Adds kernels with many instructions, and with more results than one function can have.
    void add_large() {
        for (const std::uint64_t seed : {1, 2}) {
            RandomKernelOptions options;
            options.operations = 3000;
            options.multiply_adds = false;
            options.precision = seed == 1 ? Precision::single : Precision::binary64;
            add(random_kernel(seed, options), {50, 3}, seed, fmt::format("huge kernel {}", seed));
            add(ring_of_species(20, options.precision), {50, 3}, seed,
                fmt::format("ring of species {}", seed));
        }
    }

    /// Adds products and quotients close to the smallest normal number. Some of them are below it
    /// only if they are rounded to the precision of normal numbers.
    template <typename Number>
    void add_nearly_denormal() {
        constexpr Precision precision = precision_of<Number>;
        constexpr int bias = format_of(precision).bias;
        KernelBuilder builder(precision);
        const auto field = [&](const char* name) {
            return builder.field(builder.field_slot(name));
        };
        const ValueId a = field("a");
        builder.result("product", builder.multiply(a, field("b")));
        builder.result("quotient", builder.divide(a, field("c")));
        builder.result("scaled", builder.apply(Op::scale_by_power, field("d"),
                                               builder.number(static_cast<float>(-bias))));
        const CellKernel kernel = std::move(builder).finish();
        const PlaneLayout layout(Grid{61, 20});
        std::vector<Plane<Number>> planes;
        for (int k = 0; k < 7; ++k) planes.emplace_back(layout);
        RandomStream stream(1);
        for (std::int64_t row = 0; row < layout.height; ++row) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                const Number x = 1 + std::abs(static_cast<Number>(stream.symmetric()));
                planes[0].row(row)[i] = std::ldexp(x, -bias / 2);
                planes[1].row(row)[i] = std::ldexp(1 / x, -bias / 2);
                planes[2].row(row)[i] = std::ldexp(std::nextafter(x, Number{2}), bias / 2);
                planes[3].row(row)[i] = std::nextafter(Number{2}, Number{0}) / x * x;
            }
        }
        const std::array<const Number*, 4> fields{planes[0].origin(), planes[1].origin(),
                                                  planes[2].origin(), planes[3].origin()};
        const std::array<Number*, 3> results{planes[4].origin(), planes[5].origin(),
                                             planes[6].origin()};
        const Recording recording{"results that are nearly denormal", is_exact_};
        const FlushDenormals environment;
        recorded_kernel(kernel, Stencil::plane, recording, file_)
            ->run({fields, {}, {}, results, layout}, {{0, layout.height}});
    }

    /// The names of the operations that no random kernel has used.
    std::string missing(bool links) const { return tried_.missing(links); }

private:
    CaseFile& file_;
    bool is_exact_;
    OperationCounts tried_;
    std::set<std::uint64_t> known_;
};

bool is_sound(const Script& script) {
    if (script.program) return true;
    std::fprintf(stderr, "%s\n", script.messages(false).c_str());
    return false;
}

bool add_scripts(Cases& cases, std::uint64_t first_seed) {
    std::vector<Script> scripts;
    for (const LibraryText& text : library_texts()) {
        scripts.push_back(load_script(std::string(text.file_name), std::string(text.text), ""));
    }
    const auto examples = std::filesystem::path(CASCADE_SOURCE_DIR) / "examples";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
        if (entry.path().extension() != ".cascade") continue;
        auto loaded = load_script_file(entry.path());
        if (!loaded) {
            std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
            return false;
        }
        scripts.push_back(std::move(loaded->script));
    }
    for (std::uint64_t seed = first_seed; seed < first_seed + 60; ++seed) {
        Overrides overrides;
        if (seed % 3 == 0) overrides.precision = Precision::binary64;
        scripts.push_back(load_script(fmt::format("random script {}", seed), random_script(seed),
                                      examples, overrides));
    }
    for (const Script& script : scripts) {
        if (!is_sound(script)) return false;
        cases.add_script(script);
    }
    return true;
}

bool make_cases(bool is_exact, const std::string& path) {
    if (!is_exact) keep_denormals();
    CaseFile file(path);
    Cases grids(file, is_exact), links(file, is_exact);
    const std::uint64_t seed = new_seed() + 10000;  // The other seeds begin at 1.
    for (const std::uint64_t first : {std::uint64_t{1}, seed}) {
        for (const Precision precision : {Precision::single, Precision::binary64}) {
            grids.add_random(first, 400, precision, false);
            links.add_random(first, 150, precision, true);
        }
    }
    grids.add_large();
    grids.add_nearly_denormal<float>();
    grids.add_nearly_denormal<double>();
    if (!add_scripts(grids, seed)) return false;
    std::printf("%d cases\n", file.cases);
    const std::string missing = grids.missing(false) + links.missing(true);
    if (missing == "multiply_addmultiply_add") return true;
    std::fprintf(stderr, "operations that were never tried: %s\n", missing.c_str());
    return false;
}

}  // namespace
}  // namespace cascade::test

int main(int count, char** arguments) {
    const std::string_view mode = count == 3 ? arguments[1] : "";
    if (mode != "kept" && mode != "exact") {
        std::fprintf(stderr, "usage: wasm_cases kept|exact FILE\n");
        return 64;
    }
    return cascade::test::make_cases(mode == "exact", arguments[2]) ? 0 : 1;
}
