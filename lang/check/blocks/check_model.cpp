// Checks the settings of a domain that is a model: mesh, cells, laplacian, unit, and named
// surfaces.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/check_directions.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/program/models.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace cascade::checking {

namespace {

/// The arguments that a surface needs in brackets. Surfaces that are not in this table have no
/// arguments.
struct ShapeSizes {
    ModelShape shape;
    std::size_t most;
    std::string_view arguments;  ///< A description of the arguments for messages.
    std::string_view example;
};
constexpr std::array<ShapeSizes, 4> shape_sizes{{
    {ModelShape::torus, 2, "its two radii", "torus(1, 0.4)"},
    {ModelShape::box, 3, "its three sides", "box(1, 1, 2)"},
    {ModelShape::knot, 1, "the radius of its tube", "knot(0.4)"},
    {ModelShape::implicit, 1,
     "an expression of x, y and z and, optionally, half the side of its box",
     "implicit(1 - x^2 - y^2 - z^2)"},
}};

const ShapeSizes* sizes_of(ModelShape shape) {
    for (const ShapeSizes& sizes : shape_sizes) {
        if (sizes.shape == shape) return &sizes;
    }
    return nullptr;
}

std::optional<ModelShape> shape_of(std::string_view word) {
    return word == word_of(ModelShape::implicit) ? ModelShape::implicit : shape_named(word);
}

/// The statement of a block that names a surface; null if there is none. An incorrect statement for
/// the same setting may come before this statement.
const ast::Statement* model_surface_of(const ast::Script& script, const ast::Block& domain) {
    for (const ast::Statement& statement : domain.statements) {
        if (statement.name.text == "surface" && is_model_surface(script, statement))
            return &statement;
    }
    return nullptr;
}

/// The statement of a block that names a model; null if there is none.
const ast::Statement* model_of(const ast::Script& script, const ast::Block& domain) {
    for (const ast::Statement& statement : domain.statements) {
        if (statement.name.text == "mesh" && !statement.values.empty()) return &statement;
    }
    return model_surface_of(script, domain);
}

/// The statement of the option --mesh, which names a file or a shape; null if the option is not
/// used.
const ast::Statement* model_option(const ast::Script& script) {
    const ast::Statement* mesh = find_option(script, "mesh");
    return mesh != nullptr ? mesh : find_option(script, "surface");
}

class ModelChecker {
public:
    ModelChecker(Workspace& work, const ast::Script& script, const ast::Block& domain)
        : work_(work), script_(script), domain_(domain), option_(model_option(script)) {}

    void check() {
        if (option_ != nullptr) {
            check_named(*option_);
        } else {
            const ast::Statement* mesh = find("mesh");
            const ast::Statement* surface = model_surface_of(script_, domain_);
            if (mesh != nullptr && surface != nullptr) {
                return report_twice(work_, surface->name.span, mesh->name.span,
                                    "a domain can have a mesh or a surface, but not both");
            }
            check_named(mesh != nullptr ? *mesh : *surface);
        }
        if (!model_) return;
        // `unit` and the settings that rotate a model refer to the surface or model that the script
        // names. They do not refer to the model of --mesh.
        const bool is_own = option_ == nullptr;
        if (const auto* cells = find("cells")) check_cells(*cells);
        if (const auto* laplacian = find("laplacian")) {
            put(model_->laplacian, read_word(work_, script_, *laplacian));
        }
        const auto* unit = is_own || model_of(script_, domain_) ? find("unit") : nullptr;
        if (unit != nullptr) put(model_->unit, read_number(work_, script_, *unit));
        if (const auto* up = is_own ? find("up") : find_option(script_, "up")) check_up(*up);
        const auto* facing = is_own ? find("facing") : find_option(script_, "facing");
        if (facing != nullptr) check_facing(*facing);
        check_anisotropy(find("directions"), find("stretch"));
        if (is_own) {
            for (const ast::Statement& other : domain_.statements) refuse(other);
        } else {
            leave_borders();
            if (const auto* grid = find_option(script_, "grid")) refuse(*grid);
        }
        take_model();
    }

private:
    const ast::Statement* find(std::string_view name) const {
        if (const auto* option = find_option(script_, name)) return option;
        for (const ast::Statement& statement : domain_.statements) {
            if (statement.name.text == name && !statement.values.empty()) return &statement;
        }
        return nullptr;
    }

    /// Reports a setting that only grids have.
    void refuse(const ast::Statement& statement) {
        const std::string_view word = statement.name.text;
        const auto setting = setting_named(word);
        if (!setting || includes(info(*setting).domains, Domains::model)) return;
        const bool is_shape = word == "grid" || word == "spacing" || word == "metric";
        work_.diagnostics.error(statement.name.span, fmt::format("a model has no {}", word),
                                is_shape
                                    ? "write cells: 20000 or --cells 20000 to spread cells over "
                                      "the model"
                                : word == "front"
                                    ? "write facing: -y, for example, for the axis along which "
                                      "the model looks"
                                    : "leave it out: nothing flows out where the surface of a "
                                      "model ends");
    }

    /// If --mesh replaces the script's plane by a model, drops the rules at the sides of the plane.
    void leave_borders() {
        const DomainSettings& domain = work_.program.domain;
        if (domain.mask) {
            work_.diagnostics.warning(domain.mask->span,
                                      "this mask is ignored, because a model "
                                      "has no mask");
        }
        for (const auto& side : domain.sides) {
            if (!side || !takes_value(side->kind)) continue;
            work_.diagnostics.warning(side->span,
                                      "this side is ignored, because a model has no "
                                      "sides");
        }
        const ast::Statement* extent = find("extent");
        const auto reads_time = [&](ast::Expression value) { return reads_t(value); };
        const bool is_left = subject_of_extent(script_, domain_) == ExtentOf::nothing;
        if (extent != nullptr && is_left && std::ranges::any_of(extent->values, reads_time)) {
            work_.diagnostics.warning(extent->name.span,
                                      "this growth is ignored, because a model replaces the grid");
        }
        if (const ast::Statement* stencil = find("stencil")) {
            work_.diagnostics.warning(stencil->span,
                                      "this stencil is ignored, because a model "
                                      "has no stencil");
        }
    }

    /// Whether an expression contains the time.
    bool reads_t(ast::Expression value) const {
        for (ast::ExprId id = value.first; id <= value.root; ++id) {
            const auto* const name = std::get_if<ast::Name>(&script_.expressions[id].node);
            if (name != nullptr && name->name == "t") return true;
        }
        return false;
    }

    /// Resets the domain to the defaults of a model. Keeps seed and precision.
    void take_model() {
        DomainSettings& domain = work_.draft->domain;
        domain.grid = rows_of_cells(model_->count);
        domain.mask.reset();
        domain.stencil = StencilKind::cross;
        domain.surface.reset();
        domain.sides = {};
        domain.model = std::move(model_);
    }

    void check_named(const ast::Statement& statement) {
        if (statement.name.text == "mesh") check_mesh(statement);
        else check_shape(statement);
    }

    Span span_of(const ast::Statement& statement) const {
        return value_of(script_, statement).span;
    }

    void check_mesh(const ast::Statement& statement) {
        if (!has_one_value(work_, script_, statement)) return;
        const ast::Expr& value = value_of(script_, statement);
        if (std::holds_alternative<ast::Garbage>(value.node)) return;
        const auto* text = std::get_if<ast::Text>(&value.node);
        if (text == nullptr || text->value.empty()) {
            work_.diagnostics.error(value.span, "'mesh' takes the name of a file in quotes",
                                    shape_of(word_of(value))
                                        ? fmt::format("write surface: {}", word_of(value))
                                        : "for example, mesh: \"horse.ply\"");
            return;
        }
        model_.emplace();
        model_->path = text->value;
        model_->span = value.span;
    }

    void check_shape(const ast::Statement& statement) {
        const ast::Expr& value = value_of(script_, statement);
        const ModelShape shape = *shape_of(word_of(value));
        const ShapeSizes* sizes = sizes_of(shape);
        const std::vector<ast::Expression> arguments = arguments_of(script_, statement.values[0]);
        const bool is_implicit = shape == ModelShape::implicit;
        const bool has_box = is_implicit && arguments.size() == 2;
        const bool fits = sizes != nullptr && arguments.size() == sizes->most;
        if (!fits && !has_box && (is_implicit || !arguments.empty())) {
            if (sizes == nullptr) {
                work_.diagnostics.error(value.span,
                                        fmt::format("'{}' stands alone", word_of(shape)),
                                        fmt::format("surface: {}", word_of(shape)));
            } else {
                work_.diagnostics.error(value.span,
                                        fmt::format("{} takes {} in brackets", word_of(shape),
                                                    sizes->arguments),
                                        fmt::format("for example, surface: {}", sizes->example));
            }
            return;
        }
        ModelSettings model;
        model.shape = shape;
        model.span = value.span;
        if (is_implicit) {
            Scope scope;
            scope.context = Context::position;
            scope.reads_volumes = true;
            auto checked = check_number(work_, script_, arguments[0], scope);
            if (!checked) return;
            model.implicit = std::move(checked->formula);
        }
        for (const ast::Expression each : std::span(arguments).subspan(is_implicit ? 1 : 0)) {
            const auto size = check_constant(work_, script_, each, "a size");
            if (!size) return;
            if (!(*size >= 1e-6 && *size <= 1e6)) {
                work_.diagnostics.error(script_.expressions[each.root].span,
                                        "a size must be from 1e-6 to 1e6");
                return;
            }
            model.sizes.push_back(*size);
        }
        if (model.shape == ModelShape::torus && !model.sizes.empty() &&
            model.sizes[1] >= model.sizes[0]) {
            work_.diagnostics.error(value.span, "the tube of a torus must be thinner than its ring",
                                    "for example, surface: torus(1, 0.4)");
            return;
        }
        if (model.shape == ModelShape::knot && !model.sizes.empty() && model.sizes[0] > 0.55) {
            work_.diagnostics.error(value.span, "the radius of a knot's tube must be at most 0.55",
                                    "for example, surface: knot(0.4)");
            return;
        }
        model_ = std::move(model);
    }

    void check_cells(const ast::Statement& statement) {
        if (!has_one_value(work_, script_, statement)) return;
        const std::string_view word = word_of(value_of(script_, statement));
        if (word == "faces" || word == "vertices") {
            model_->cells = word == "faces" ? ModelCellKind::faces : ModelCellKind::vertices;
            return;
        }
        if (std::holds_alternative<ast::Name>(value_of(script_, statement).node)) {
            work_.diagnostics.error(span_of(statement),
                                    "'cells' must be a number, faces or "
                                    "vertices",
                                    did_you_mean(work_, word, words_taken_by(Setting::cells)));
            return;
        }
        put(model_->count, read_number(work_, script_, statement));
    }

    void check_up(const ast::Statement& statement) {
        if (const auto axis = read_word(work_, script_, statement)) {
            model_->stance = usual_stance(static_cast<Axis>(*axis));
        }
    }

    void check_facing(const ast::Statement& statement) {
        if (!has_one_value(work_, script_, statement)) return;
        const ast::Expr* value = &value_of(script_, statement);
        const auto* minus = std::get_if<ast::Unary>(&value->node);
        const bool is_backwards = minus != nullptr && minus->op == Function::negate;
        if (is_backwards) value = &script_.expressions[minus->operand];
        const auto axis = axis_of_name(word_of(*value));
        if (!axis) {
            work_.diagnostics.error(span_of(statement),
                                    "the axis along which a model looks must be x, -x, y, -y, z "
                                    "or -z");
        } else if (*axis == model_->stance.up) {
            work_.diagnostics.error(
                span_of(statement),
                fmt::format("the model cannot look along {}, because this axis points upwards",
                            name_of(*axis)),
                *axis == Axis::y ? "choose another axis, or write up: z if z points upwards"
                                 : "choose another axis");
        } else {
            model_->stance.facing = {*axis, is_backwards};
        }
    }

    void check_anisotropy(const ast::Statement* directions, const ast::Statement* stretch) {
        if (directions != nullptr)
            model_->directions = check_directions(work_, script_, *directions);
        if (model_->directions && model_->cells != ModelCellKind::spread) {
            work_.diagnostics.error(model_->directions->span,
                                    "only cells that are spread over a model can be stretched",
                                    "for example, cells: 20000, or --cells 20000");
        }
        if (stretch == nullptr) return;
        if (directions == nullptr) {
            work_.diagnostics.error(stretch->name.span,
                                    "'stretch' needs 'directions', along "
                                    "which it stretches the cells",
                                    "for example, directions: axis(0, 1, 0)");
            return;
        }
        put(model_->stretch, read_number(work_, script_, *stretch));
    }

    Workspace& work_;
    const ast::Script& script_;
    const ast::Block& domain_;
    const ast::Statement* option_;  ///< The option that names the model; null if a block names it.
    std::optional<ModelSettings> model_;
};

}  // namespace

bool is_model_setting(std::string_view name) {
    const auto setting = setting_named(name);
    return setting && info(*setting).domains == Domains::model;
}

bool is_model_surface(const ast::Script& script, const ast::Statement& surface) {
    return surface.values.size() == 1 && shape_of(word_of(value_of(script, surface)));
}

ExtentOf subject_of_extent(const ast::Script& script, const ast::Block& domain) {
    const bool has_model = model_of(script, domain) != nullptr;
    if (model_option(script) != nullptr) return has_model ? ExtentOf::surface : ExtentOf::nothing;
    if (has_model) return find_option(script, "grid") ? ExtentOf::grid : ExtentOf::surface;
    const auto is_surface = [](const ast::Statement& statement) {
        return statement.name.text == "surface" && !statement.values.empty();
    };
    return std::ranges::any_of(domain.statements, is_surface) ? ExtentOf::surface : ExtentOf::grid;
}

bool check_model(Workspace& work, const ast::Script& script, const ast::Block& domain) {
    const ast::Statement* own = model_of(script, domain);
    const bool gives_way = own != nullptr && find_option(script, "grid") != nullptr;
    if (model_option(script) != nullptr || (own != nullptr && !gives_way)) {
        ModelChecker(work, script, domain).check();
        return true;
    }
    if (gives_way) {
        work.diagnostics.warning(value_of(script, *own).span,
                                 "the requested grid replaces this model");
    }
    const auto refuse = [&](const ast::Statement& statement) {
        if (statement.values.empty() || !is_model_setting(statement.name.text)) return;
        work.diagnostics.error(
            statement.name.span, "this setting needs a domain with a model",
            "add mesh: \"horse.ply\" or surface: sphere, or run with --mesh sphere");
    };
    std::for_each(script.options.begin(), script.options.end(), refuse);
    if (!gives_way) std::for_each(domain.statements.begin(), domain.statements.end(), refuse);
    return gives_way;
}

}  // namespace cascade::checking
