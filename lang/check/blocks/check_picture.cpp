// Checks the `picture` block: the colour, the material of fields, and, for crawling cells, the
// shape and the quantities of the shape.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/check_growth.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/names/unknown_names.h"
#include "lang/check/blocks/check_shape.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/program/stage_kinds.h"
#include "lang/vocabulary/settings.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace cascade::checking {

namespace {

/// The last stage that takes a step. If no stage takes a step, the last stage.
std::uint32_t shown_stage(const Program& program) {
    for (std::size_t i = program.stages.size(); i > 0; --i) {
        if (program.stages[i - 1].iterations > 0) return static_cast<std::uint32_t>(i - 1);
    }
    return static_cast<std::uint32_t>(program.stages.size() - 1);
}

class PictureChecker {
public:
    PictureChecker(Workspace& work, const ast::Script& script, const std::vector<ShapeForm>& shapes)
        : work_(work), script_(script), shapes_(shapes) {
        scope_.context = Context::picture;
        if (work.program.stages.empty()) return;
        scope_.stage = shown_stage(work.program);
        scope_.system = work.program.stages[*scope_.stage].system;
        scope_.last_stage = static_cast<std::uint32_t>(work.program.stages.size() - 1);
    }

    void check(const ast::Statement& statement) {
        const std::string_view name = statement.name.text;
        const bool is_value = statement.kind == ast::StatementKind::value;
        const bool is_setting = is_value && is_setting_of(SettingBlock::picture, name);
        const bool is_quantity = is_value && shape() != nullptr && shape()->find(name);
        if (!is_setting && !is_quantity) return report_no_setting(statement.name);
        if (!scope_.stage || !has_one_value(work_, script_, statement)) return;
        if (is_quantity) return check_type(statement, ValueType::number);
        const Setting setting = *setting_named(name);
        if (setting == Setting::color) return check_type(statement, ValueType::colour);
        if (setting == Setting::height) return check_type(statement, ValueType::number);
        if (is_material(setting)) return check_material(statement, setting);
        if (setting == Setting::body) return check_body(statement);
        if (!shows_cells()) return report_no_cells(statement.name);
        if (setting == Setting::shape) return check_shape(statement);
        if (setting == Setting::detail) return void(read_number(work_, script_, statement));
        if (setting == Setting::skin) return check_skin(statement);
        check_type(statement, ValueType::number);
    }

private:
    bool knows_stage() const { return scope_.system != unknown_system; }
    bool shows_cells() const {
        if (!knows_stage()) return true;  // An error has been reported.
        return work_.program.systems[scope_.system].cells.has_value();
    }
    static bool is_material(Setting setting) {
        return setting == Setting::roughness || setting == Setting::metalness ||
               setting == Setting::opacity || setting == Setting::emission;
    }

    bool are_fields(const ast::Word& name) {
        if (!knows_stage() || !shows_cells()) return true;
        work_.diagnostics.error(
            name.span, fmt::format("'{}' works only in pictures of fields", name.text),
            fmt::format("the picture shows stage '{}', which consists of cells that crawl",
                        work_.program.stages[*scope_.stage].name));
        return false;
    }

    /// Checks the body. A body has no meaning on a model. The domain may be a model because --mesh
    /// has replaced the script's volume.
    void check_body(const ast::Statement& statement) {
        if (!are_fields(statement.name)) return;
        const DomainSettings& domain = work_.program.domain;
        if (domain.grid.depth == 1 && !domain.model) {
            work_.diagnostics.error(statement.name.span, "'body' needs a grid with slices",
                                    "for example, domain { grid: 64, 64, 64 }");
            return;
        }
        check_type(statement, ValueType::number);
    }

    void check_material(const ast::Statement& statement, Setting setting) {
        if (!are_fields(statement.name)) return;
        const bool is_colour = setting == Setting::emission;
        check_type(statement, is_colour ? ValueType::colour : ValueType::number);
    }

    void report_no_setting(const ast::Word& name) {
        // The shape may lack a quantity because it has errors, which have been reported.
        if (!knows_shape()) return;
        std::vector<std::string> known = settings_of({SettingBlock::picture});
        if (shape() != nullptr) {
            for (const ItemId item : shape()->quantities.ids()) {
                if (item.index() >= ShapeForm::known_count) {
                    known.push_back(shape()->quantities[item].name);
                }
            }
        }
        const std::string hint = hint_about(work_, name.text, WordContext::picture, known);
        work_.diagnostics.error(name.span,
                                fmt::format("'{}' is not a setting of the picture", name.text),
                                hint.empty() ? "a picture has color: …" : hint);
    }

    void report_no_cells(const ast::Word& name) {
        work_.diagnostics.error(
            name.span, fmt::format("'{}' works only in pictures of cells that crawl", name.text),
            fmt::format("the picture shows stage '{}', which consists of fields",
                        work_.program.stages[*scope_.stage].name));
    }

    /// Checks the skin, which is the colour of the surface below the cells. Names in its formula
    /// refer to the last stage of fields.
    void check_skin(const ast::Statement& statement) {
        Scope scope = scope_;
        const bool knows_systems =
            std::ranges::none_of(work_.program.stages,
                                 [](const Stage& stage) { return stage.system == unknown_system; });
        if (!knows_systems) return;
        if (const auto stage = stage_of_fields_before(work_.program, *scope_.stage)) {
            scope.stage = stage;
            scope.system = work_.program.stages[*stage].system;
        }
        check_type(statement, ValueType::colour, scope);
    }

    void check_type(const ast::Statement& statement, ValueType type) {
        check_type(statement, type, scope_);
    }

    void check_type(const ast::Statement& statement, ValueType type, const Scope& scope) {
        const auto checked = check_expression(work_, script_, statement.values[0], scope);
        if (!checked) return;
        if (checked->type() != type) {
            const bool is_colour = type == ValueType::colour;
            work_.diagnostics.error(script_.expressions[statement.values[0].root].span,
                                    fmt::format("{} must be {}", statement.name.text,
                                                words_of(type, true).name),
                                    is_colour ? "use rgb(…) or palette(…)" : "");
            return;
        }
        if (scope.stage) can_grow(work_.program, *scope.stage, checked->formula, work_.diagnostics);
        mark_reads(work_, checked->formula, scope.system);
    }

    void check_shape(const ast::Statement& statement) {
        const ast::Expr& value = value_of(script_, statement);
        const auto* name = std::get_if<ast::Name>(&value.node);
        // A string is the name of a file.
        if (std::holds_alternative<ast::Text>(value.node)) return;
        if (name == nullptr) {
            work_.diagnostics.error(value.span,
                                    "'shape' takes a word or the name of a file in "
                                    "quotes",
                                    "write shape: thorn or shape: \"horn.ply\", for example");
        } else if (!is_declared(name->name) && shape() == nullptr) {
            report_unknown_shape(work_, script_, {value.span, name->name});
        }
    }

    /// The word after `shape:`. Empty if the block does not contain this setting.
    std::string_view said_shape() const {
        const auto said = picture_expression(script_, "shape");
        const auto* const name =
            said ? std::get_if<ast::Name>(&script_.expressions[said->root].node) : nullptr;
        return name != nullptr ? name->name : std::string_view();
    }
    const ShapeForm* shape() const { return find_shape(shapes_, said_shape()); }
    bool is_declared(std::string_view name) const {
        return std::ranges::any_of(script_.blocks, [&](const ast::Block& block) {
            return block.kind == ast::BlockKind::shape && block.name.text == name;
        });
    }
    bool knows_shape() const { return shape() != nullptr || !is_declared(said_shape()); }

    Workspace& work_;
    const ast::Script& script_;
    const std::vector<ShapeForm>& shapes_;
    Scope scope_;
};

}  // namespace

const ast::Block* find_block(Workspace& work, const ast::Script& script, ast::BlockKind kind,
                             std::string_view name) {
    const ast::Block* first = nullptr;
    for (const ast::Block& block : script.blocks) {
        if (block.kind != kind) continue;
        if (first == nullptr) {
            first = &block;
        } else {
            report_twice(work, block.keyword.span, first->keyword.span,
                         fmt::format("there are two {} blocks", name));
        }
    }
    return first;
}

void report_sides(Workspace& work, const ast::Block& block) {
    for (const ast::Statement& statement : block.sides) {
        work.diagnostics.error(join(statement.name.span, statement.side.span),
                               "the side of one species cannot be set in the domain, only in a "
                               "system or a stage",
                               "'left: …' in the domain sets the side of all species");
    }
}

void check_picture(Workspace& work, const ast::Script& script,
                   const std::vector<ShapeForm>& shapes) {
    const ast::Block* block = find_block(work, script, ast::BlockKind::picture, "picture");
    if (block == nullptr) return;
    report_sides(work, *block);
    PictureChecker checker(work, script, shapes);
    std::unordered_map<std::string_view, Span> seen;
    for (const ast::Statement& statement : block->statements) {
        if (statement.name.empty() || statement.values.empty()) continue;
        const auto [first, is_new] = seen.try_emplace(statement.name.text, statement.name.span);
        if (is_new) {
            checker.check(statement);
        } else {
            report_twice(work, statement.name.span, first->second,
                         fmt::format("'{}' is given a value twice", statement.name.text));
        }
    }
}

}  // namespace cascade::checking
