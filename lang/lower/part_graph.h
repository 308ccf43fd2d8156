// The formulas of a stage as one graph of parts (internal to lowering).
//
// Definitions and rates are replaced by what they stand for, equal parts are one part, and operands
// come before what reads them. Where a part is computed, and how often, is decided later
// (lang/lower/pass_planner.h).
#pragma once

#include "lang/program/program.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace cascade::lowering {

/// Where the random numbers of a formula come from.
struct Noise {
    std::string origin;       ///< The item's or definition's name, or a species' with a prime.
    bool every_step = false;  ///< New numbers in each step.
    std::string owner = {};   ///< Whose numbers they are; empty: the stage's.
};

/// Number of a part in its graph.
using PartId = std::uint32_t;

/// What stands beyond the two sides of an axis where a part is read at neighbours.
enum class Beyond : std::uint8_t {
    anything,  ///< The part is the same everywhere, or the axis has one cell.
    periodic,  ///< What it is in the opposite cells.
    mirrored,  ///< What it is in the cells at the sides.
    itself,    ///< Of a species what its sides say; of a function of such what it makes of them.
};

struct Part {
    Node node;  ///< Its operands are positions in a formula: see below.
    std::array<PartId, most_operands> operands{};
    std::uint32_t operand_count = 0;
    const Formula* formula = nullptr;  ///< Where it is written; none of parts that are made here.
    std::uint32_t position = 0;        ///< In that formula.
    const Noise* noise = nullptr;      ///< Of parts that draw random numbers.
    std::size_t draw = 0;              ///< Which draw of its formula, from 1.
    bool is_uniform = false;           ///< The same in all cells.
    bool is_step_invariant = false;    ///< The same in all steps of the stage.

    std::array<Beyond, 3> beyond{};  ///< By axis.

    /// Is it beyond some side neither what it is in the opposite cell nor what it is in the cell
    /// at the side? Then its plane has no halo, and it is computed there.
    bool is_open() const {
        return beyond[0] == Beyond::itself || beyond[1] == Beyond::itself ||
               beyond[2] == Beyond::itself;
    }

    bool calls(Function function) const {
        return node.kind == NodeKind::call && node.function == function;
    }
};

/// The cells that formulas are about.
enum class Extent : std::uint8_t {
    domain,  ///< Those inside the mask, where there is one.
    grid,    ///< All, whatever the mask.
};

/// The plane that has a built-in value on a model; nothing of t and step.
std::optional<ModelPlane> model_plane_of(Builtin builtin);

/// What counts as step-invariant: what no step changes, or all but t and step.
enum class Invariance : std::uint8_t { parameters, state };

class PartGraph {
public:
    PartGraph(const Program& program, std::uint32_t stage,
              Invariance step_invariants = Invariance::parameters, Extent extent = Extent::domain)
        : program_(program),
          stage_(stage),
          step_invariant_(step_invariants),
          has_metric_(program.domain.surface && program.domain.surface->has_metric),
          has_mask_(program.domain.mask && extent == Extent::domain),
          has_model_(program.domain.model.has_value()) {}

    /// Adds a formula and returns the part that is its value. What it reads of `own` items,
    /// definitions and rates is taken from the parts set for them; own items without one are read
    /// from planes and numbers.
    PartId add(const Formula& formula, const Noise& noise);
    void set_own(std::uint32_t item, PartId part) { own_[item] = part; }
    void set_definition(std::uint32_t index, PartId part);
    void set_rate(std::uint32_t item, PartId part);
    /// The difference across a side, for a derivative `value` along its outward unit normal: on a
    /// surface cells have lengths. Of surfaces whose rows and columns meet at right angles there.
    PartId across_side(PartId value, Side side);
    /// The part that reads an item of this stage from its plane or number.
    PartId item(std::uint32_t item);
    /// The definition or rate that a part is the value of, as a user calls it; "" for others.
    const std::string& name(PartId part) const;

    const Program& program() const { return program_; }
    std::uint32_t stage() const { return stage_; }
    /// Are there cells of the grid that are no part of the domain?
    bool has_mask() const { return has_mask_; }
    /// Do cells read neighbours over links? Then operators read planes alone, and `lap` of two
    /// operands is div(first * grad(second)).
    bool is_linked() const { return has_model_; }
    std::size_t size() const { return parts_.size(); }
    const Part& operator[](PartId id) const { return parts_[id]; }
    /// Species, parameters that vary, files and the metric lie in planes from the start.
    bool is_plane(PartId id) const;
    /// How the halo of a part's plane is filled. Of one that is not open.
    Boundaries boundary(PartId id) const;

private:
    PartId intern(Part part);
    PartId inside_mask(PartId of, Function aggregate);
    PartId call(Function function, std::initializer_list<PartId> operands,
                ValueType type = ValueType::number);
    PartId tensor(const Part& part);

    // On a surface (surface_parts.cpp).
    /// What a call becomes there; calls of what is no operator stay as they are.
    PartId on_surface(const Part& part);
    PartId metric(MetricPlane plane);
    PartId sum_of_products(PartId a, PartId b, PartId c, PartId d);
    PartId in_cells(PartId tensor);
    PartId flow_tensor(PartId tensor);
    PartId flow_of_gradient(PartId gradient);
    PartId flow_of_vector(PartId along, PartId across);
    PartId flow_times_tensor(PartId tensor, PartId flow);
    PartId along_row(PartId of);
    PartId across_row(PartId of);

    // On a model (model_parts.cpp).
    PartId on_model(const Part& part);
    PartId model(ModelPlane plane);
    PartId number(double value);
    /// A vector as a sum of gradients of numbers, each times a number.
    using Gradients = std::vector<std::pair<PartId, PartId>>;  ///< Of, factor.
    const Gradients& gradients_of(PartId vector) const { return gradients_.at(vector); }
    Gradients sum_of_gradients(const Part& part);
    PartId divergence_over_links(const Gradients& gradients);

    bool is_uniform(const Part& part) const;
    bool is_step_invariant(const Part& part) const;
    std::array<Beyond, 3> beyond(const Part& part) const;

    const Program& program_;
    std::uint32_t stage_;
    Invariance step_invariant_;
    std::vector<Part> parts_;
    std::deque<Noise> noises_;
    std::unordered_multimap<std::uint64_t, PartId> known_;
    std::unordered_map<std::uint32_t, PartId> own_, definitions_, rates_;
    std::unordered_map<PartId, std::string> names_;
    bool has_metric_ = false, has_mask_ = false, has_model_ = false;
    std::unordered_map<PartId, Gradients> gradients_;  ///< Of the vectors on a model.
    /// What the simplest flows on a surface are made of: a gradient, or two components.
    std::unordered_map<PartId, std::pair<PartId, std::optional<PartId>>> flows_;
};

}  // namespace cascade::lowering
