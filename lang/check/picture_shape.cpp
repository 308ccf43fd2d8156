// Finds the shape that a checked script names.
#include "lang/check/picture_shape.h"

#include "lang/check/blocks/check_shape.h"
#include "lang/check/expressions/check_expression.h"
#include "lang/library/library.h"
#include "lang/syntax/picture_expression.h"
#include "core/check.h"

namespace cascade {

PictureShape picture_shape(const ast::Script& script, Sources& sources) {
    PictureShape shape;
    std::string_view name = usual_shape;
    Program program;
    // These are not printed, because the errors were reported when the script was loaded.
    Diagnostics unspoken;
    checking::Workspace work{program, unspoken, {}, {}, {}, {}, {}, 0};
    if (const auto detail = picture_expression(script, "detail")) {
        shape.detail =
            checking::check_constant(work, script, *detail, "detail").value_or(shape.detail);
    }
    if (const auto expression = picture_expression(script, "shape")) {
        const ast::Expr& value = script.expressions[expression->root];
        shape.span = value.span;
        if (const auto* text = std::get_if<ast::Text>(&value.node)) {
            shape.path = text->value;
            return shape;
        }
        if (const auto* word = std::get_if<ast::Name>(&value.node)) name = word->name;
    }
    const ast::Script functions = cell_functions_of(sources);
    if (!functions.functions.empty()) work.cell_functions = &functions;
    const std::vector<ShapeForm> shapes = checking::check_shapes(work, script, sources);
    const ShapeForm* const found = checking::find_shape(shapes, name);
    shape.form = found != nullptr ? *found : library_shape(usual_shape);
    return shape;
}

ShapeForm library_shape(std::string_view name) {
    Program program;
    Diagnostics never_any;
    Sources sources;
    checking::Workspace work{program, never_any, {}, {}, {}, {}, {}, 0};
    const std::vector<LibraryScript> library = read_library_shapes({name}, sources, never_any);
    const std::vector<ShapeForm> shapes = checking::checked_shapes(work, {}, library);
    const ShapeForm* const found = checking::find_shape(shapes, name);
    CHECK(found, "a shape of the library");
    return *found;
}

}  // namespace cascade
