// The equations of a steady state of a stage: all rates are 0 in all cells.
//
// The unknowns are the values of the species in the cells of the domain. The unknown of species s
// in cell k has the number k · species + s.
#pragma once

#include "continuation/field_expressions.h"
#include "continuation/padded_grid.h"
#include "core/result.h"
#include "lang/program/program.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cascade::continuation {

/// The rates at a state, and their derivatives.
struct Linearised {
    Vector rates;
    SparseColumns jacobian;  ///< The derivatives by the unknowns.
    Vector by_parameter;
};

/// Checks, before anything is run, whether a stage can have steady states that continuation/ can
/// compute. If not, fails with the reason, worded to continue a sentence that begins with the
/// stage.
Result<void> check_steady(const Program& program, std::uint32_t stage);

class SteadyProblem {
public:
    /// `varied` is a parameter that is the same in all cells. Parameters that depend on it change
    /// with it. Fails in the same cases as check_steady(), and if an expression is not supported.
    /// The program must outlive the problem. `constants` also gives the planes of a model or of a
    /// metric.
    static Result<SteadyProblem> create(const Program& program, std::uint32_t stage,
                                        const DomainCells& cells, ItemId varied,
                                        const ConstantValues& constants);

    Index size() const { return cell_count() * species_count(); }
    Index cell_count() const { return grid_->cell_count(); }
    Index species_count() const { return static_cast<Index>(species_.size()); }
    /// The area of each cell, as a multiple of the mean area.
    const Vector& areas() const { return areas_; }

    Vector rates(const Vector& state, double parameter);
    Linearised linearised(const Vector& state, double parameter);

    /// The totals that no rate changes, one in each column, as weights of the unknowns. They are
    /// totals of species and of sums of species, in which cells count by their areas. The slopes of
    /// the rates are taken at a state near the given one, where no slope is 0 by accident.
    Matrix conserved_near(const Vector& state, double parameter);
    /// The derivatives of a state along the motions that give other steady states. On a model these
    /// are the rotations of a sphere or torus. On a grid they are translations along the axes that
    /// are periodic and along which no rate depends on the position.
    std::vector<Vector> motions(const Vector& state) const;
    /// A motion counts only if more than this fraction of it is orthogonal to the motions before
    /// it. The fraction is larger on a model, whose motions are not exact.
    double least_part() const { return turns_.empty() ? 0.02 : 0.2; }
    /// Changes of the species that `like` changes most, symmetric about the first cell. For each
    /// axis, one of the changes is in all cells at position 0 of this axis. The last change is only
    /// in the first cell.
    std::vector<Vector> even_shapes(const Vector& like) const;

private:
    SteadyProblem() = default;

    /// A species with its values beyond sides.
    struct Species {
        ItemId item;
        SparseRows inside;  ///< Maps the unknowns to values in the padded grid.
        /// For each side with a value, the number of its root in `sides_`, and the effect of the
        /// value on the halo.
        std::vector<std::pair<std::size_t, SparseRows>> by_side;
    };
    void prepare_sides(lowering::Expressions& sides, const Program& program, std::uint32_t stage,
                       Flattening& flattening);
    void extend(Species& species, Index number, const lowering::SideKinds& kinds,
                const std::map<int, std::size_t>& values);
    void find_free_axes();
    void find_areas(const DomainCells& cells);
    Vector assembled(const std::vector<Part>& roots) const;
    ItemParts parts_at(const Vector& state, double parameter, bool with_slopes);

    std::shared_ptr<const PaddedGrid> grid_;
    ItemId varied_;
    std::vector<Species> species_;
    std::array<bool, 3> is_periodic_{true, true, true};
    Vector areas_;
    std::vector<int> free_axes_;     ///< The axes along which states can be moved.
    std::vector<SparseRows> turns_;  ///< For each rotation, the derivative of a state along it.
    Vector turned(const SparseRows& turn, const Vector& state) const;
    Vector shifted(int axis, const Vector& state) const;
    void find_turns(const DomainCells& cells);
    std::shared_ptr<FieldExpressions> rates_, sides_;
};

}  // namespace cascade::continuation
