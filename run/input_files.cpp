#include "run/input_files.h"

#include "picture/grey_picture.h"
#include "picture/npy.h"

#include <fmt/format.h>

#include <cstdio>
#include <set>
#include <string>

namespace cascade {

namespace {

void read_one(Script& script, const Node& node, InputFiles& files) {
    const std::string& name = script.program->texts[node.index];
    const Grid& grid = script.program->domain.grid;
    const auto path = readable_path(script.folder, name, script.overrides.reads);
    if (!path) return script.diagnostics.error(node.span, path.error().message, path.error().hint);
    const Precision precision = script.program->domain.precision;
    const auto array = read_npy(*path, precision);
    if (!array) {
        script.diagnostics.error(node.span, array.error().message, array.error().hint);
    } else if (!fits(*array, grid)) {
        script.diagnostics.error(
            node.span,
            array->slices == 1 && grid.depth == 1
                ? fmt::format("'{}' has {} rows and {} columns, but the grid has {} and {}", name,
                              array->rows, array->columns, grid.height, grid.width)
                : fmt::format("'{}' has {} slices, {} rows and {} columns, but the grid has {}, "
                              "{} and {}",
                              name, array->slices, array->rows, array->columns, grid.depth,
                              grid.height, grid.width),
            array->slices == 1
                ? fmt::format("a grid of {}, {} would fit", array->columns, array->rows)
                : fmt::format("a grid of {}, {}, {} would fit", array->columns, array->rows,
                              array->slices));
    } else {
        files.add(node.index, to_field(*array, precision));
    }
}

void read_image(Script& script, const Node& node, InputFiles& files) {
    const std::string& name = script.program->texts[node.index];
    const Grid& grid = script.program->domain.grid;
    const auto path = readable_path(script.folder, name, script.overrides.reads);
    if (!path) return script.diagnostics.error(node.span, path.error().message, path.error().hint);
    const auto picture = read_grey_picture(*path);
    if (!picture) {
        return script.diagnostics.error(node.span, picture.error().message, picture.error().hint);
    }
    const Field plane = to_field(resized(*picture, grid.width, grid.height), grid);
    files.add_image(node.index, plane.converted(script.program->domain.precision));
}

}  // namespace

Result<InputFiles> read_input_files(Script& script) {
    InputFiles files;
    std::set<std::uint32_t> arrays, images;  // A file is read, and its fault told, once.
    const auto read_of = [&](const Formula& formula) {
        for (const Node& node : formula.nodes) {
            if (node.kind != NodeKind::call) continue;
            const Node& path = formula.nodes[node.operands[0]];
            if (node.function == Function::field && arrays.insert(path.index).second) {
                read_one(script, path, files);
            }
            if (node.function == Function::image && images.insert(path.index).second) {
                read_image(script, path, files);
            }
        }
    };
    if (script.program->domain.mask) read_of(script.program->domain.mask->formula);
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        for (const Formula& formula : script.program->stages[k].items) read_of(formula);
    }
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return files;
}

}  // namespace cascade
