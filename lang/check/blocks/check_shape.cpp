// Checks each shape as a small system, whose first quantities are t, s and the number of the part.
// Some names of definitions have a fixed meaning.
#include "lang/check/blocks/check_shape.h"

#include "core/check.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_cycles.h"
#include "lang/check/names/note_uses.h"
#include "lang/check/systems/typed_definitions.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/library/library.h"
#include "lang/program/flatten.h"
#include "lang/vocabulary/settings.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace cascade::checking {

namespace {

constexpr std::array<const char*, ShapeForm::known_count> known_names{"t", "s", "part"};

/// A definition whose name has a fixed meaning.
struct Meant {
    const char* name;
    Formula ShapeForm::*formula;
    ValueType type;
};
constexpr std::array<Meant, 4> meant_definitions{{
    {"place", &ShapeForm::place, ValueType::vector},
    {"radius", &ShapeForm::radius, ValueType::number},
    {"middle", &ShapeForm::middle, ValueType::vector},
    {"shade", &ShapeForm::shade, ValueType::number},
}};

const Meant* meant_by(std::string_view name) {
    const auto found = std::ranges::find(meant_definitions, name, &Meant::name);
    return found == meant_definitions.end() ? nullptr : &*found;
}

class ShapeChecker {
public:
    ShapeChecker(Workspace& work, const DerivedSystem& derived, SystemId index)
        : work_(work), derived_(derived), index_(index) {}

    /// Checks the shape and returns it. nullopt if the shape has an error.
    std::optional<ShapeForm> run();

private:
    System& system() { return work_.draft->systems[index_]; }
    void declare(const Declaration& declaration);
    void check_parts(const Declaration& declaration);
    void check_quantity(ItemId item, const Declaration& declaration);
    void check_meant();
    Formula whole(DefinitionId definition);

    Workspace& work_;
    const DerivedSystem& derived_;
    SystemId index_;
    ShapeForm form_;
    std::vector<Declaration> declarations_;
    std::unordered_map<std::string, Span> declared_;
    IdVector<ItemId, const Declaration*> values_;
    IdVector<DefinitionId, const Declaration*> definitions_;
};

void ShapeChecker::declare(const Declaration& declaration) {
    const std::string& name = declaration.name;
    const Span span = declaration.span();
    const auto refuse = [&](std::string message, std::string hint = "") {
        work_.diagnostics.error(span, std::move(message), std::move(hint));
    };
    const bool is_value = declaration.kind() == ast::StatementKind::value;
    if (!is_value && declaration.kind() != ast::StatementKind::definition) {
        return refuse(
            fmt::format("'{}' belongs to a shape, so it cannot have a rate or bounds", name),
            fmt::format("write {} = … for a definition", declaration.statement->name.text));
    }
    const auto [first, is_new] = declared_.try_emplace(name, span);
    if (!is_new) {
        return report_twice(work_, span, first->second,
                            fmt::format("'{}' is given a value twice", name));
    }
    const auto is_known = [&](const char* known) { return name == known; };
    if (std::ranges::any_of(known_names, is_known) || reserved(name) == Reserved::builtin) {
        return refuse(fmt::format("'{}' is built in and cannot be declared", name));
    }
    if (is_value && name == "parts") return check_parts(declaration);
    if (is_setting_of(SettingBlock::picture, name)) {
        return refuse(fmt::format("'{}' cannot be defined in a shape, because it is a setting of "
                                  "pictures",
                                  name),
                      "choose another name");
    }
    if (is_value && meant_by(name) != nullptr) {
        return refuse(fmt::format("'{}' in a shape must be written with '='", name),
                      fmt::format("write {} = …", name));
    }
    if (is_value) {
        Quantity quantity;
        quantity.name = name;
        quantity.span = span;
        quantity.doc = declaration.doc;
        system().quantities.push_back(std::move(quantity));
        values_.push_back(&declaration);
    } else {
        system().definitions.push_back({name, span, {}});
        definitions_.push_back(&declaration);
    }
}

void ShapeChecker::check_parts(const Declaration& declaration) {
    if (!has_one_value(work_, *declaration.script, *declaration.statement)) return;
    const ast::Expression value = declaration.statement->values[0];
    const auto count = check_constant(work_, *declaration.script, value, "parts");
    if (!count) return;
    if (*count == std::floor(*count) && *count >= 1 && *count <= most_shape_parts) {
        form_.parts = static_cast<std::uint32_t>(*count);
        return;
    }
    work_.diagnostics.error(declaration.script->expressions[value.root].span,
                            fmt::format("the number of parts must be a whole number from 1 to {}",
                                        most_shape_parts));
}

void ShapeChecker::check_quantity(ItemId item, const Declaration& declaration) {
    if (!has_one_value(work_, *declaration.script, *declaration.statement)) return;
    const auto value = check_constant(work_, *declaration.script, declaration.statement->values[0],
                                      fmt::format("'{}' of a shape", declaration.name));
    if (declaration.range != nullptr) {
        check_range(work_, declaration, system().quantities[item], value);
    }
    form_.usual[item.index()] = value.value_or(0);
}

/// The formula of a definition. The formulas of definitions that it reads take the place of these
/// definitions.
Formula ShapeChecker::whole(DefinitionId definition) {
    ExpressionGraph graph;
    Flattening flattening(graph);
    flattening.add_rates(system());
    const Node read{definition};
    return formula_of(graph.nodes(), flattening.add({{read}}));
}

void ShapeChecker::check_meant() {
    for (const DefinitionId id : system().definitions.ids()) {
        const Definition& definition = system().definitions[id];
        const Meant* const meant = meant_by(definition.name);
        if (meant == nullptr) continue;
        work_.definitions_read[index_][id] = true;
        if (definition.formula.nodes.back().type != meant->type) {
            work_.diagnostics.error(definition.formula.nodes.back().span,
                                    fmt::format("'{}' of a shape must be {}", definition.name,
                                                words_of(meant->type, true).name),
                                    meant->type == ValueType::vector ? "write vector(x, y, z)"
                                                                     : "");
            continue;
        }
        form_.*(meant->formula) = whole(id);
    }
    const bool is_tube = !form_.radius.nodes.empty() || !form_.middle.nodes.empty();
    if (!form_.place.nodes.empty() && is_tube) {
        work_.diagnostics.error(
            form_.span, fmt::format("shape '{}' defines its positions in two ways", form_.name),
            "write either place = …, or radius = … and middle = …");
    } else if (form_.place.nodes.empty() && form_.radius.nodes.empty()) {
        work_.diagnostics.error(form_.span, fmt::format("shape '{}' has no radius", form_.name),
                                "write radius = 1 - t");
    }
}

std::optional<ShapeForm> ShapeChecker::run() {
    const std::size_t errors_before = work_.diagnostics.error_count();
    form_.name = system().name;
    form_.span = system().span;
    form_.built_in = derived_.from.built_in;
    for (const char* known : known_names) {
        Quantity quantity;
        quantity.name = known;
        quantity.span = form_.span;
        system().quantities.push_back(std::move(quantity));
        values_.push_back(nullptr);
    }
    declarations_ = system_declarations(work_, system(), derived_.statements);
    for (const Declaration& declaration : declarations_) declare(declaration);
    work_.names[index_] = names_of(system());
    note_declarations(work_, index_);
    work_.items_read[index_].assign(system().item_count(), false);
    for (std::uint32_t k = 0; k < ShapeForm::known_count; ++k) {
        work_.items_read[index_][ItemId(k)] = true;
    }
    work_.definitions_read[index_].assign(system().definitions.size(), false);
    system().rates.resize(system().quantities.size());
    form_.usual.assign(system().quantities.size(), 0);
    for (const ItemId item : values_.ids()) {
        if (values_[item] != nullptr) check_quantity(item, *values_[item]);
    }
    check_typed_definitions(work_, index_, Context::shape, definitions_);
    const auto is_missing = [](const Definition& each) { return each.formula.nodes.empty(); };
    if (std::ranges::any_of(system().definitions, is_missing)) return std::nullopt;
    order_steps(work_, index_);
    if (work_.diagnostics.error_count() != errors_before) return std::nullopt;
    check_meant();
    if (work_.diagnostics.error_count() != errors_before) return std::nullopt;
    form_.quantities = system().quantities;
    return std::move(form_);
}

std::vector<SystemBlock> blocks_of(const ast::Script& script,
                                   const std::vector<LibraryScript>& library) {
    std::vector<SystemBlock> blocks;
    for (const LibraryScript& each : library) {
        blocks.push_back({&each.script, &each.script.blocks[each.block], true});
    }
    for (const ast::Block& block : script.blocks) {
        if (block.kind == ast::BlockKind::shape) blocks.push_back({&script, &block, false});
    }
    return blocks;
}

/// Adds an empty system for a shape. Reports a second shape of the same name.
SystemId add_system(Workspace& work, const SystemBlock& from) {
    System system;
    system.name = std::string(from.block->name.text);
    system.span = from.block->name.span;
    system.built_in = from.built_in;
    const SystemId index = work.program.systems.next();
    const auto [found, is_new] = work.systems.try_emplace(system.name, index);
    if (!is_new && work.program.systems[found->second].built_in) {
        found->second = index;
    } else if (!is_new && !system.name.empty()) {
        report_twice(work, system.span, work.program.systems[found->second].span,
                     fmt::format("there are two shapes '{}'", system.name));
    }
    work.draft->systems.push_back(std::move(system));
    work.names.emplace_back();
    work.items_read.emplace_back();
    work.definitions_read.emplace_back();
    work.incomplete.push_back(from.block->is_damaged);
    return index;
}

/// The names of shapes that the library may contain.
std::vector<std::string_view> shapes_wanted(const ast::Script& script) {
    std::vector<std::string_view> own, wanted;
    for (const ast::Block& block : script.blocks) {
        if (block.kind != ast::BlockKind::shape) continue;
        own.push_back(block.name.text);
        wanted.push_back(block.base.text);
    }
    const auto said = picture_expression(script, "shape");
    const auto* const name =
        said ? std::get_if<ast::Name>(&script.expressions[said->root].node) : nullptr;
    if (name != nullptr && std::ranges::find(own, name->name) == own.end()) {
        wanted.push_back(name->name);
    }
    return wanted;
}

}  // namespace

/// Checks the shapes of a script and of the texts `library`, and returns the shapes that have no
/// errors.
std::vector<ShapeForm> checked_shapes(Workspace& work, const ast::Script& script,
                                      const std::vector<LibraryScript>& library) {
    const std::vector<SystemBlock> blocks = blocks_of(script, library);
    if (blocks.empty()) return {};
    // Reports mistakes in functions here, so that they are reported only once.
    functions_of(work, script);
    Program program;
    Workspace own{program, work.diagnostics, {}, {}, {}, {}, {}, 0};
    own.draft = &program;
    own.functions = work.functions;
    own.cell_functions = work.cell_functions;
    own.uses = work.uses;
    std::vector<ShapeForm> shapes;
    const std::vector<DerivedSystem> derived = derive_systems(own, blocks);
    std::vector<SystemId> numbers;
    for (const DerivedSystem& each : derived) {
        report_sides(own, *each.from.block);
        const SystemId index = add_system(own, each.from);
        numbers.push_back(index);
        if (each.base) program.systems[index].base = numbers[*each.base];
        if (!each.is_known) continue;
        auto form = ShapeChecker(own, each, index).run();
        CHECK(form || !each.from.built_in, "the shapes of the library are sound");
        if (form) shapes.push_back(*std::move(form));
    }
    if (!work.diagnostics.has_errors()) warn_unread(own);
    return shapes;
}

std::vector<ShapeForm> check_shapes(Workspace& work, const ast::Script& script, Sources& sources) {
    return checked_shapes(work, script,
                          read_library_shapes(shapes_wanted(script), sources, work.diagnostics));
}

const ShapeForm* find_shape(const std::vector<ShapeForm>& shapes, std::string_view name) {
    const ShapeForm* found = nullptr;
    for (const ShapeForm& each : shapes) {
        if (each.name == name && (found == nullptr || !each.built_in)) found = &each;
    }
    return found;
}

}  // namespace cascade::checking
