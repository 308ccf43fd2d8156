// Kernels that are C++ functions of a cell, for tests. They need no IR, so the time loop is tested
// without the parts of the program that make kernels.
#pragma once

#include "core/plane.h"
#include "ir/backend.h"
#include "solvers/advance.h"

#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace cascade::test {

/// What a function of a cell may read.
struct CellView {
    const KernelArguments& arguments;
    Stencil stencil;
    std::int64_t i, j;

    std::int64_t at() const { return j * arguments.layout.stride + i; }
    float field(std::size_t slot) const { return arguments.fields[slot][at()]; }
    bool mask(std::size_t slot) const { return arguments.masks[slot][at()] != 0; }
    float uniform(std::size_t slot) const { return arguments.uniforms[slot]; }
    float laplacian(std::size_t slot) const {
        const float* c = arguments.fields[slot] + at();
        const std::int64_t stride = arguments.layout.stride;
        if (stencil == Stencil::row) return (c[1] + c[-1]) - 2.0f * c[0];
        if (stencil == Stencil::column) return (c[-stride] + c[stride]) - 2.0f * c[0];
        return ((c[-stride] + c[stride]) + c[1]) + c[-1] - 4.0f * c[0];
    }
};

/// Writes the results of a cell.
using CellFunction = std::function<void(const CellView& cell, float* results)>;

/// Runs a CellFunction. After each row it writes NaN up to the next multiple of row_pad, as kernels
/// may, so that tests notice if this memory is read.
class CellFunctionKernel : public Kernel {
public:
    CellFunctionKernel(CellFunction function, Stencil stencil)
        : function_(std::move(function)), stencil_(stencil) {}

    void run(const KernelArguments& arguments, const Patch& cells) const override {
        const PlaneLayout& layout = arguments.layout;
        const std::int64_t pad = PlaneLayout::row_pad;
        const std::int64_t padded = (layout.width + pad - 1) / pad * pad;
        ColumnRange columns = cells.columns;
        if (columns.end >= layout.width) columns.end = padded;
        std::vector<float> values(arguments.results.size());
        for (std::int64_t j = cells.rows.begin; j < cells.rows.end; ++j) {
            for (std::int64_t i = columns.begin; i < columns.end; ++i) {
                if (i < layout.width) function_({arguments, stencil_, i, j}, values.data());
                for (std::size_t k = 0; k < values.size(); ++k) {
                    arguments.results[k][j * layout.stride + i] =
                        i < layout.width ? values[k] : std::numeric_limits<float>::quiet_NaN();
                }
            }
        }
    }

private:
    CellFunction function_;
    Stencil stencil_;
};

/// The slot of a plane that does not change.
inline StepProblem::PlaneRef fixed_plane(const Field& field) { return &field; }

/// A step of one pass whose slot k is species k. All species are read at neighbours.
inline StepProblem make_problem(const Grid& grid, int species, KernelPointer kernel) {
    StepProblem problem;
    StepProblem::Pass& pass = problem.passes.emplace_back();
    pass.kernel = std::move(kernel);
    problem.grid = grid;
    using SpeciesPlane = StepProblem::SpeciesPlane;
    for (const SpeciesId k : ids_below<SpeciesId>(static_cast<std::size_t>(species))) {
        pass.fields.push_back(SpeciesPlane{k, old_register});
        pass.results.push_back({SpeciesPlane{k, new_register}, true});
    }
    problem.species_needs_halo.assign(static_cast<std::size_t>(species), true);
    return problem;
}

inline StepProblem make_problem(const Grid& grid, int species, CellFunction function) {
    return make_problem(grid, species,
                        std::make_shared<CellFunctionKernel>(std::move(function), grid.stencil()));
}

/// One explicit step of heat conduction. Uniform 0 is the diffusion coefficient times the time
/// step.
inline StepProblem heat_problem(const Grid& grid, float diffusion) {
    StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
        results[0] = cell.field(0) + cell.uniform(0) * cell.laplacian(0);
    });
    problem.passes[0].uniforms = {diffusion};
    return problem;
}

/// A field with the values of a function of column and row.
template <typename Function>
Field make_field(const Grid& grid, Function function) {
    Field field{PlaneLayout(grid)};
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            field.at(i, j) = static_cast<float>(function(i, j));
        }
    }
    return field;
}

/// The fields of a problem that has one species.
inline std::vector<Field> only_species(Field field) {
    std::vector<Field> species;
    species.push_back(std::move(field));
    return species;
}

/// The cells row after row, without halo and padding.
inline std::vector<float> cells_of(const Field& field) {
    std::vector<float> cells;
    for (std::int64_t j = 0; j < field.layout().height; ++j) {
        cells.insert(cells.end(), field.row(j), field.row(j) + field.layout().width);
    }
    return cells;
}

/// Advances with no observer and no reports.
inline StageOutcome advance_quietly(const StepProblem& problem, const Schedule& schedule,
                                    std::vector<Field>& species) {
    RunControl control;
    return advance(problem, schedule, species, control, Progress{}, Observer{});
}

/// Reproducible numbers in [0, 1) without a structure that depends on the grid.
inline double scatter(std::int64_t i, std::int64_t j) {
    const double wave =
        43758.5453 * (static_cast<double>((i * 7919 + j * 104729) % 65537) + 0.5) / 65537.0;
    return wave - static_cast<double>(static_cast<std::int64_t>(wave));
}

}  // namespace cascade::test
