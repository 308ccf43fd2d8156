// Lists the functions that have no meaning on a model, with the reasons for messages.
#include "lang/program/models.h"

#include "lang/program/cell_items.h"
#include "lang/vocabulary/function_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace cascade {

namespace {

// The number of cells in a row. Rows are so long that little padding is needed, and so short that
// they can be divided evenly among threads.
constexpr std::int64_t cells_of_row = 512;

/// The reason why an operator is refused on a model; "" if it is allowed.
std::string_view reason_against(Function function) {
    if (includes(info(function).domains, Domains::model)) return "";
    if (carries(function)) {
        return "use dot(v, grad(e)): this operator needs columns and rows, which a model does "
               "not have";
    }
    switch (function) {
        case Function::symmetric:
            return "use tensor(a1, a2, theta) with an angle such as along(grad(v)) or "
                   "along(axis(0, 1, 0))";
        case Function::convolve:
            return "use lap(e), which reads the neighbours of each cell: a "
                   "convolution needs a grid";
        case Function::shifted:
        case Function::curl: return "it needs columns and rows, which a model does not have";
        default: return "use lap(e): a model has no second derivatives along axes";
    }
}

/// Whether the script gives a position in the file for every array that the formula reads.
/// Otherwise reports an error, because cells of a model are not in rows and columns.
bool arrays_have_places(const Program& program, const Formula& formula, Diagnostics& diagnostics) {
    bool have_places = true;
    for (const Node& node : formula.nodes) {
        if (!node.calls(Function::field)) continue;
        if (!program.literals->reading(node.as<Call>()->detail).place.empty()) continue;
        have_places = false;
        diagnostics.error(node.span,
                          "field needs a position in the file, because a model has no rows and "
                          "columns",
                          "use field(\"a.npy\", sx, sy, sz), or attr(\"name\") for numbers "
                          "stored at the model's points");
    }
    return have_places;
}

/// The function of a node, if the value exists only on models. nullopt for all other nodes.
std::optional<Function> of_model_only(const Program& program, const Node& node) {
    if (const auto* id = node.as<SurfaceValueId>())
        return program.literals->surface_value(*id).function;
    if (node.is<Call>() && needs_model(node.function)) return node.function;
    return std::nullopt;
}

/// Finds vectors that are not sums of gradients multiplied by numbers. The flow of such a vector
/// through a link between stretched cells is not known.
class LooseVectors {
public:
    /// Visits the definitions of a system in order. In this order, each definition comes after the
    /// definitions that it reads.
    explicit LooseVectors(const System& system) {
        for (const Definition& each : system.definitions) {
            const auto found = in(each.formula);
            definitions_.push_back(!found.empty() && found.back());
        }
    }

    IdVector<NodeId, bool> in(const Formula& formula) const {
        IdVector<NodeId, bool> is_loose;
        for (const Node& node : formula.nodes) {
            bool loose = node.calls(Function::vector) || node.calls(Function::cross);
            const auto* const id = node.as<DefinitionId>();
            if (id != nullptr) loose = *id < definitions_.next() && definitions_[*id];
            for (const NodeId operand : node.reads()) loose = loose || is_loose[operand];
            is_loose.push_back(loose && node.type == ValueType::vector);
        }
        return is_loose;
    }

private:
    IdVector<DefinitionId, bool> definitions_;
};

bool has_meaning_on_model(const Program& program, const LooseVectors& loose, const Formula& formula,
                          Diagnostics& diagnostics) {
    bool has_meaning = arrays_have_places(program, formula, diagnostics);
    const auto refuse = [&](Span span, std::string message, std::string hint) {
        has_meaning = false;
        diagnostics.error(span, std::move(message), std::move(hint));
    };
    const bool is_stretched = program.domain.model->directions.has_value();
    const auto is_loose = loose.in(formula);
    for (const Node& node : formula.nodes) {
        if (!node.is<Call>()) continue;
        if (is_stretched && node.calls(Function::div) && is_loose[node.operands[0]]) {
            refuse(formula.nodes[node.operands[0]].span,
                   "div of this vector cannot be used on stretched cells",
                   "use div(a * grad(e)): with 'directions' in the domain, a flux must be made "
                   "of gradients");
        }
        const bool is_directed = node.calls(Function::diffuse) || node.calls(Function::tensor);
        if (is_stretched && is_directed) {
            refuse(node.span,
                   fmt::format("{} cannot be used on stretched cells",
                               info(node.function).spelling),
                   "the 'directions' of the domain already set the directions in which all "
                   "species spread");
        }
        if (node.type == ValueType::tensor &&
            info(node.function).kind == FunctionKind::arithmetic) {
            refuse(node.span, "sums and products of tensors cannot be used on a model",
                   "use one tensor(a1, a2, theta), whose arguments may be formulas");
        }
        const std::string_view reason = reason_against(node.function);
        if (reason.empty()) continue;
        refuse(node.span, fmt::format("{} cannot be used on a model", info(node.function).spelling),
               std::string(reason));
    }
    return has_meaning;
}

bool has_meaning_on_plane(const Program& program, const Formula& formula,
                          Diagnostics& diagnostics) {
    bool has_meaning = true;
    for (const Node& node : formula.nodes) {
        const auto function = of_model_only(program, node);
        if (!function) continue;
        has_meaning = false;
        const bool is_angle = *function == Function::along;
        diagnostics.error(node.span,
                          fmt::format("{} can be used only on models",
                                      is_angle ? "this direction" : info(*function).spelling),
                          is_angle
                              ? "use along(vector(1, 1)) or along(grad(e)), which also work on a "
                                "plane"
                              : "domain { mesh: \"horse.ply\" } and domain { surface: creature } "
                                "are models");
    }
    return has_meaning;
}

/// Calls `take(formula, system)` for every formula that the stages compute. Formulas of a system
/// that several stages use are visited once.
template <typename Take>
void for_each_formula(const Program& program, const Take& take) {
    IdVector<SystemId, bool> used(program.systems.size());
    for (const Stage& stage : program.stages) {
        const System& system = program.systems[stage.system];
        const auto add = [&](const Formula& formula) {
            if (!formula.nodes.empty()) take(formula, system);
        };
        if (!used[stage.system]) {
            used[stage.system] = true;
            for (const Formula& rate : system.rates) add(rate);
            for (const Definition& definition : system.definitions) add(definition.formula);
            for (const Formula* rule : rules_of(system)) add(*rule);
        }
        add(stage.remove);
        add(stage.body);
        if (stage.founders) add(stage.founders->chance);
        for (const Formula& formula : stage.items) add(formula);
        add(stage.show);
        if (stage.time.until) add(*stage.time.until);
        for (const auto& sides : stage.sides) {
            for (const SideSetting& side : sides) add(side.value);
        }
        for (const DefinitionSides& of : stage.definition_sides) {
            for (const SideSetting& side : of.sides) add(side.value);
        }
    }
}

struct NamedShape {
    ModelShape shape;
    std::string_view word;
};
/// The shapes whose name is a word in scripts. A file is named by its path, and an implicit surface
/// by a formula in brackets.
constexpr std::array named_shapes{
    NamedShape{ModelShape::sphere, "sphere"},     NamedShape{ModelShape::torus, "torus"},
    NamedShape{ModelShape::box, "box"},           NamedShape{ModelShape::knot, "knot"},
    NamedShape{ModelShape::creature, "creature"}, NamedShape{ModelShape::leopard, "leopard"},
    NamedShape{ModelShape::giraffe, "giraffe"},   NamedShape{ModelShape::zebra, "zebra"},
    NamedShape{ModelShape::fish, "fish"},         NamedShape{ModelShape::frog, "frog"},
};

}  // namespace

Grid rows_of_cells(std::int64_t cells) {
    Grid grid;
    grid.width = std::min(std::max<std::int64_t>(cells, 1), cells_of_row);
    grid.height = (std::max<std::int64_t>(cells, 1) + grid.width - 1) / grid.width;
    grid.boundary = Boundary::no_flux;
    grid.linked = true;
    return grid;
}

std::optional<ModelShape> shape_named(std::string_view word) {
    for (const NamedShape& named : named_shapes) {
        if (named.word == word) return named.shape;
    }
    return std::nullopt;
}

std::string_view word_of(ModelShape shape) {
    if (shape == ModelShape::implicit) return "implicit";
    for (const NamedShape& named : named_shapes) {
        if (named.shape == shape) return named.word;
    }
    return "";
}

std::optional<ModelPlane> model_plane_of(Builtin builtin) {
    switch (builtin) {
        case Builtin::x: return ModelPlane::x;
        case Builtin::y: return ModelPlane::y;
        case Builtin::z: return ModelPlane::z;
        case Builtin::sx: return ModelPlane::sx;
        case Builtin::sy: return ModelPlane::sy;
        case Builtin::sz: return ModelPlane::sz;
        case Builtin::nx: return ModelPlane::nx;
        case Builtin::ny: return ModelPlane::ny;
        case Builtin::nz: return ModelPlane::nz;
        case Builtin::curvature: return ModelPlane::curvature;
        case Builtin::curvature_mean: return ModelPlane::curvature_mean;
        case Builtin::curvature_gauss: return ModelPlane::curvature_gauss;
        case Builtin::curvature_high: return ModelPlane::curvature_high;
        case Builtin::curvature_low: return ModelPlane::curvature_low;
        case Builtin::t:
        case Builtin::step: break;
    }
    return std::nullopt;
}

bool has_meaning_on_domain(const Program& program, const Formula& formula, const System& system,
                           Diagnostics& diagnostics) {
    if (!program.domain.model) return has_meaning_on_plane(program, formula, diagnostics);
    // Here only arrays are checked in systems of cells, because other functions that these systems
    // lack are refused where they are written.
    return system.cells ? arrays_have_places(program, formula, diagnostics)
                        : has_meaning_on_model(program, LooseVectors(system), formula, diagnostics);
}

bool has_meaning_on_domain(const Program& program, Diagnostics& diagnostics) {
    bool has_meaning = true;
    const System* known = nullptr;
    std::optional<LooseVectors> loose;
    for_each_formula(program, [&](const Formula& formula, const System& system) {
        if (!program.domain.model) {
            has_meaning &= has_meaning_on_plane(program, formula, diagnostics);
        } else if (system.cells) {
            has_meaning &= arrays_have_places(program, formula, diagnostics);
        } else {
            if (known != &system) loose.emplace(system);
            known = &system;
            has_meaning &= has_meaning_on_model(program, *loose, formula, diagnostics);
        }
    });
    return has_meaning;
}

std::vector<const Formula*> formulas_of(const Program& program) {
    std::vector<const Formula*> formulas;
    for_each_formula(program,
                     [&](const Formula& formula, const System&) { formulas.push_back(&formula); });
    return formulas;
}

}  // namespace cascade
