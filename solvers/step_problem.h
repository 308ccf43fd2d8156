// The computation of one step: passes over planes, with aggregates between them.
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
    /// A plane that a pass reads or writes. A Field is constant and has the problem's precision.
    using PlaneRef = std::variant<SpeciesPlane, TemporaryId, const Field*>;

    struct CompleteSteps {};  ///< The number of complete steps when the step begins.
    /// Makes random numbers differ from step to step (ir/draw_of_step.h).
    struct StepDraw {};
    /// The time t when the step begins, plus `part` times the step.
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
        bool needs_halo = false;              ///< Whether the result is read at neighbours.
        Boundaries boundary = {};             ///< The sides of a temporary without `rules`.
        std::optional<SpeciesId> rules = {};  ///< A temporary's index in `sides`, if it has rules.
        /// The fraction of the step at which the result's halo is read, or next_step. Only for a
        /// species, or a temporary with rules.
        double read_at = next_step;
        static constexpr double next_step = -1;
    };

    /// The way to find the field that satisfies a constraint `0 = e` (solvers/constraint_solver.h).
    /// Each problem below writes its result to its last temporary. The problems read the registers
    /// of the enclosing problem, `unknown`, and the planes `constant`.
    struct Solve {
        /// A part of e that does not change with the field.
        struct Part {
            std::shared_ptr<Field> plane;
            Boundaries boundary = {};
        };
        TemporaryId target;
        bool needs_halo = false;  ///< Whether the target is read at neighbours.
        SideRules sides;  ///< The rules at the field's sides, before any value at a side changes.
        std::optional<SpeciesId> rules = {};  ///< The index of these rules in StepProblem::sides.
        RegisterId in_register;               ///< The register of the species that the rules read.
        double read_at =
            0;  ///< The fraction of the step at which the species in `in_register` are read.
        std::shared_ptr<const StepProblem> whole, linear, parts;  ///< `parts` may be null.
        std::shared_ptr<Field> unknown;
        std::vector<Part> constant;  ///< The results of `parts`.
        /// The areas of cells, 0 outside the mask and in the padding of a linked grid; null if all
        /// cells have the same area.
        std::shared_ptr<const Field> areas;
        std::shared_ptr<SolveReport> report;  ///< Never null.
    };

    /// A sum over the cells around each cell, for whole planes (solvers/convolution.h).
    struct Convolution {
        PlaneRef operand;
        TemporaryId target;
        bool needs_halo = false;   ///< The rules at the sides that fill the target's halo.
        Boundaries boundary = {};  ///< The rules that fill the target's halo.
        std::shared_ptr<const WeightedLags> weights;
    };

    /// A factor of a species' diffusion.
    struct DiffusionFactor {
        double value = 0;
        std::optional<AggregateId> aggregate;  ///< If set, replaces `value`.
    };

    struct Pass {
        std::vector<Solve> solves;              ///< Done before the convolutions.
        std::vector<Convolution> convolutions;  ///< Done in order before the reductions.
        std::vector<Reduction> reductions;      ///< Done before the kernel runs.
        std::optional<SweepFilter> filter;  ///< Done after the reductions, before the kernel runs.
        /// The kernel as instructions; null if only its executable form is known.
        std::shared_ptr<const CellKernel> source;
        /// Runs the pass. Null in a problem that is only described (bind_plan()) and never runs.
        KernelPointer kernel;
        std::vector<PlaneRef> fields;  ///< One per field slot of the kernel.
        /// Whether the kernel reads neighbours by links, for each of its field slots. If the vector
        /// is empty, the kernel may read neighbours of all fields.
        std::vector<bool> read_by_links;
        std::vector<const Mask*> masks;  ///< One per mask slot of the kernel.
        /// The values of the uniforms, rounded if the problem is in single precision.
        std::vector<double> uniforms;
        std::vector<ChangingUniform> changing;
        std::vector<Result> results;
    };

    Grid grid;
    /// The links, in the problem's precision. Null unless the grid is linked.
    const Links* links = nullptr;
    /// The number of cells that count in a mean. Excludes cells outside a mask and the padding of a
    /// linked grid's last row. 0: all cells count.
    std::int64_t cells_inside = 0;
    Precision precision = Precision::single;
    std::vector<Pass> passes;  ///< In order; at least one.
    std::uint32_t registers = 2;
    std::optional<RegisterId> error_register;  ///< Holds an estimate of the step's error.
    /// The number of passes at the start that only write the first rate register, with the rates at
    /// the old step. The last rate register gets the rates at the new step. After a step, the two
    /// registers are swapped, and these first passes are left out. 0 if the scheme has no rate
    /// registers.
    std::size_t first_rate_passes = 0;
    std::optional<RateRegisters> rate_registers;
    std::vector<CurveRate> curve;  ///< See Scheme::curve.
    std::uint32_t temporaries = 0;
    std::uint32_t aggregates = 0;
    /// The diffusion of each species, for filters.
    std::vector<DiffusionTerms<DiffusionFactor>> diffusion;
    /// The rules at the sides, first of each species, then of each temporary. If empty, the grid's
    /// boundary applies to all.
    std::vector<SideRules> sides;
    std::span<const ChangingSide> changing_sides;  ///< The sides whose values change.
    SideMoment sides_moment;                       ///< The moment of `sides`.
    /// Whether the old step of each species is read at neighbours.
    std::vector<bool> species_needs_halo;

    /// Whether the planes have halos.
    bool has_halo() const { return !grid.linked; }
    /// The number of cells that count in a mean.
    std::int64_t counted_cells() const {
        return cells_inside > 0 ? cells_inside : grid.cell_count();
    }
    /// The number of cells at the start of a row that count in a mean. With a mask this is the
    /// whole row, because values outside the mask are 0.
    std::int64_t counted_in_row(std::int64_t row) const {
        if (!grid.linked) return grid.width;
        return std::clamp(counted_cells() - row * grid.width, std::int64_t{0}, grid.width);
    }
    /// Whether some kernel is still interpreted, so that steps may become many times faster.
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
    /// The rules of sides_of(), with the values at sides that set_side_values() computes for a
    /// moment.
    SideRules sides_of(SpeciesId species, SideMoment moment, const SpeciesPlanes& present,
                       const Patch& cells) const {
        SideRules rules = sides_of(species);
        set_side_values(changing_sides, species, moment, present, PlaneLayout(grid), cells, rules);
        return rules;
    }
    /// Fills the halos of all species for the moment of `sides`, if neighbours are read beyond the
    /// sides. A FlushDenormals must exist in the calling scope.
    void fill_halos(std::span<Field> species) const { fill_halos(species, sides_moment); }
    /// Does the same as fill_halos() above, but for another moment.
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
