// What the time loop computes in one step: passes over planes, with aggregates between them.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "ir/backend.h"
#include "ir/diffusion.h"
#include "ir/reduction.h"
#include "solvers/changing_side.h"
#include "solvers/convolution.h"
#include "solvers/scheme.h"
#include "solvers/solve_report.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace cascade {

struct StepProblem {
    struct SpeciesPlane {
        SpeciesId species;
        RegisterId in_register;
        friend auto operator<=>(SpeciesPlane, SpeciesPlane) = default;
    };
    /// A plane that a pass reads or writes. A field is constant and has the problem's precision.
    using PlaneRef = std::variant<SpeciesPlane, TemporaryId, const Field*>;

    struct CompleteSteps {};  ///< When the step begins.
    struct StepDraw {};       ///< That step's word in draws (ir/draw_of_step.h).
    /// t when the step begins, plus a fraction of the step.
    struct MomentAt {
        double part = 0;
    };
    /// A uniform that changes from step to step.
    struct ChangingUniform {
        UniformSlot slot;
        std::variant<CompleteSteps, StepDraw, MomentAt, AggregateId, Sweep::Coefficient> value;
    };

    struct Reduction {
        ReductionKind kind = ReductionKind::sum;
        PlaneRef operand;
        AggregateId aggregate;
    };

    struct Result {
        PlaneRef plane;
        bool needs_halo = false;              ///< Is read at neighbours.
        Boundaries boundary = {};             ///< The sides of a temporary without `rules`.
        std::optional<SpeciesId> rules = {};  ///< A temporary's index in `sides`, if any.
        /// For a species and for such a temporary: the fraction of the step at which it is read at
        /// neighbours, or next_step.
        double read_at = next_step;
        static constexpr double next_step = -1;
    };

    /// A field that makes e of a constraint `0 = e` zero (solvers/constraint_solver.h). The results
    /// of its problems are their last temporaries. They read the registers of the enclosing
    /// problem, `unknown`, and the planes `constant`.
    struct Solve {
        /// A part of e that does not change with the field.
        struct Part {
            std::shared_ptr<Field> plane;
            Boundaries boundary = {};
        };
        TemporaryId target;
        bool needs_halo = false;              ///< The target is read at neighbours.
        SideRules sides;                      ///< Sides of the field, before any of them changes.
        std::optional<SpeciesId> rules = {};  ///< Their number in StepProblem::sides, …
        RegisterId in_register;               ///< … which read species here …
        double read_at = 0;                   ///< … at this fraction of the step.
        std::shared_ptr<const StepProblem> whole, linear, parts;  ///< The last one may be null.
        std::shared_ptr<Field> unknown;
        std::vector<Part> constant;  ///< The results of `parts`.
        /// The areas of cells, 0 outside the mask and in the padding of a linked grid; null: all
        /// cells are alike.
        std::shared_ptr<const Field> areas;
        std::shared_ptr<SolveReport> report;  ///< Never null.
    };

    /// A sum over the cells around each cell, for whole planes (solvers/convolution.h).
    struct Convolution {
        PlaneRef operand;
        TemporaryId target;
        bool needs_halo = false;   ///< The target is read at neighbours.
        Boundaries boundary = {};  ///< How its halo is filled.
        std::shared_ptr<const WeightedLags> weights;
    };

    /// A factor of a species' diffusion.
    struct DiffusionFactor {
        double value = 0;
        std::optional<AggregateId> aggregate;  ///< Replaces the number.
    };

    struct Pass {
        std::vector<Solve> solves;              ///< Done before the convolutions.
        std::vector<Convolution> convolutions;  ///< Done in order before the reductions.
        std::vector<Reduction> reductions;      ///< Done before the kernel runs.
        std::optional<SweepFilter> filter;      ///< Done after them, before the kernel runs.
        /// What the kernel computes; null if only its executable form is known.
        std::shared_ptr<const CellKernel> source;
        KernelPointer kernel;          ///< Null in a problem that is only described (bind_plan()).
        std::vector<PlaneRef> fields;  ///< Per field slot of the kernel.
        /// Per field slot: is it read in the cells to which links lead? Empty: all may be.
        std::vector<bool> read_by_links;
        std::vector<const Mask*> masks;  ///< Per mask slot of the kernel.
        std::vector<double> uniforms;    ///< Rounded in single precision.
        std::vector<ChangingUniform> changing;
        std::vector<Result> results;
    };

    Grid grid;
    const Links* links = nullptr;  ///< Null unless the grid is linked; in the problem's precision.
    /// The number of cells in a mean, without cells outside a mask or the padding of the last row
    /// of a linked grid; 0: all cells.
    std::int64_t cells_inside = 0;
    Precision precision = Precision::single;
    std::vector<Pass> passes;  ///< In order; at least one.
    std::uint32_t registers = 2;
    std::optional<RegisterId> error_register;  ///< An estimate of the step's error.
    /// The number of passes at the start that only write the first of the rate registers, with the
    /// rates of the old step. The last one gets the rates of the new step. After a step, the two
    /// are swapped and those passes are left out. 0 without rate registers.
    std::size_t first_rate_passes = 0;
    std::optional<RateRegisters> rate_registers;
    std::uint32_t temporaries = 0;
    std::uint32_t aggregates = 0;
    std::vector<DiffusionTerms<DiffusionFactor>> diffusion;  ///< Per species, for filters.
    /// By species, then by temporary; empty: the grid's boundary for all.
    std::vector<SideRules> sides;
    std::span<const ChangingSide> changing_sides;  ///< The sides that change.
    SideMoment sides_moment;                       ///< The moment of `sides`.
    std::vector<bool> species_needs_halo;  ///< Per species: the old step is read at neighbours.

    /// Does reading neighbours beyond the sides need a halo?
    bool has_halo() const { return !grid.linked; }
    /// The number of cells in a mean.
    std::int64_t counted_cells() const {
        return cells_inside > 0 ? cells_inside : grid.cell_count();
    }
    /// The number of cells at the start of a row that count in a mean. Values outside a mask are 0,
    /// so whole rows count there.
    std::int64_t counted_in_row(std::int64_t row) const {
        if (!grid.linked) return grid.width;
        return std::clamp(counted_cells() - row * grid.width, std::int64_t{0}, grid.width);
    }
    /// Is some kernel still interpreted, so that steps may become many times faster?
    bool is_provisional() const {
        return std::any_of(passes.begin(), passes.end(),
                           [](const Pass& pass) { return pass.kernel->is_provisional(); });
    }
    /// The rules at the sides of a plane that a pass writes.
    SideRules sides_of(const Result& result) const {
        const auto* const own = std::get_if<SpeciesPlane>(&result.plane);
        if (own == nullptr && !result.rules) return SideRules(result.boundary);
        return sides_of(own != nullptr ? own->species : *result.rules);
    }
    SideRules sides_of(SpeciesId species) const {
        return sides.empty() ? SideRules(grid.boundary) : sides[species.index()];
    }
    /// The same at a moment, for the halo filled from these cells; see set_side_values().
    SideRules sides_of(SpeciesId species, SideMoment moment, const SpeciesPlanes& present,
                       const Patch& cells) const {
        SideRules rules = sides_of(species);
        set_side_values(changing_sides, species, moment, present, PlaneLayout(grid), cells, rules);
        return rules;
    }
    /// Fills the halos of all species for the moment of `sides`, if neighbours are read beyond the
    /// sides. Must run inside a FlushDenormals.
    void fill_halos(std::span<Field> species) const { fill_halos(species, sides_moment); }
    /// The same for another moment.
    void fill_halos(std::span<Field> species, SideMoment moment) const {
        if (!has_halo()) return;
        const SpeciesPlanes present = planes_of(species);
        for (std::size_t s = 0; s < species.size(); ++s) {
            const Patch here{species[s].layout().rows};
            species[s].fill_halo(sides_of(SpeciesId(s), moment, present, here));
        }
    }
};

}  // namespace cascade
