// Every text is read once, through GrantedFiles. Faults are reported at the text in the script.
#include "run/domain/input_files.h"

#include "core/check.h"
#include "core/printable.h"
#include "core/resample.h"
#include "picture/grey_picture.h"
#include "picture/npy.h"
#include "run/domain/carried_cells.h"
#include "run/domain/surface_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

namespace cascade {

namespace {

TextId text_of(const Node& node) { return std::get<TextId>(node.kind); }

/// Parses a file that the script names.
template <typename Parse>
auto read_granted(const Script& script, const std::string& name, std::uint64_t largest,
                  const Parse& parse) -> decltype(parse(std::string_view())) {
    const auto bytes = GrantedFiles(script.folder, script.overrides.reads).read(name, largest);
    if (!bytes) return tl::unexpected(bytes.error());
    auto parsed = parse(*bytes);
    if (parsed) return parsed;
    return failure(fmt::format("cannot read '{}': {}", short_name(name), parsed.error().message),
                   parsed.error().hint);
}

void read_one(Script& script, const Node& node, InputFiles& files) {
    const std::string& name = script.program->literals->text(text_of(node));
    const std::int64_t detail = script.program->domain.detail;
    const Grid grid = coarser(script.program->domain.grid, detail);
    const Precision precision = script.program->domain.precision;
    const auto array = read_granted(script, name, largest_npy_file, [&](std::string_view bytes) {
        return parse_npy(bytes, precision);
    });
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
        Field values = to_field(*array, precision);
        if (detail > 1) values = carrier_on_grid(grid, detail, nullptr, nullptr)->carried(values);
        files.add({Function::field, text_of(node)}, std::move(values));
    }
}

/// The pixels of a PNG; nothing with a diagnostic.
std::optional<GreyPicture> read_picture(Script& script, const Node& node) {
    const std::string& name = script.program->literals->text(text_of(node));
    auto picture = read_granted(script, name, largest_picture_file, parse_grey_picture);
    if (picture) return *std::move(picture);
    script.diagnostics.error(node.span, picture.error().message, picture.error().hint);
    return std::nullopt;
}

void read_image(Script& script, const Node& node, InputFiles& files) {
    const Grid& grid = script.program->domain.grid;
    const auto picture = read_picture(script, node);
    if (!picture) return;
    const Field plane = to_field(resized(*picture, grid.width, grid.height), grid);
    files.add({Function::image, text_of(node)}, plane.converted(script.program->domain.precision));
}

/// The values that the model has at its points, or of a picture painted on it.
void read_of_model(Script& script, const Node& node, Function function, const ModelCells& model,
                   InputFiles& files) {
    const Precision precision = script.program->domain.precision;
    const auto add = [&](Result<Field> plane) {
        if (plane) return files.add({function, text_of(node)}, *std::move(plane));
        script.diagnostics.error(node.span, plane.error().message, plane.error().hint);
    };
    if (function == Function::attr) {
        const std::string& name = script.program->literals->text(text_of(node));
        add(attribute_plane(name, model, precision));
    } else if (const auto picture = read_picture(script, node)) {
        add(painted_plane(*picture, model, precision));
    }
}

/// Calls `read(function, text)` for each text that the script's formulas read, once.
template <typename Read>
void each_text_read(const Script& script, const Read& read) {
    std::set<NamedPlane> known;
    const auto read_of = [&](const Formula& formula) {
        for (const Node& node : formula.nodes) {
            if (!node.is<Call>() || !reads_file(node.function)) continue;
            const Node& text = formula.nodes[node.operands[0]];
            if (known.insert({node.function, text_of(text)}).second) read(node.function, text);
        }
    };
    if (script.program->domain.mask) read_of(script.program->domain.mask->formula);
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        for (const Formula& formula : script.program->stages[k].items) read_of(formula);
    }
}

}  // namespace

std::vector<std::string> input_file_names(const Script& script) {
    std::vector<std::string> names;
    each_text_read(script, [&](Function function, const Node& text) {
        const std::string& name = script.program->literals->text(text_of(text));
        const bool is_known = std::find(names.begin(), names.end(), name) != names.end();
        if (function != Function::attr && !is_known) names.push_back(name);
    });
    return names;
}

Result<void> check_attributes(Script& script, const SurfaceMesh& mesh) {
    each_text_read(script, [&](Function function, const Node& text) {
        if (function != Function::attr) return;
        const auto found = find_attribute(script.program->literals->text(text_of(text)), mesh);
        if (!found) script.diagnostics.error(text.span, found.error().message, found.error().hint);
    });
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return {};
}

Result<InputFiles> read_input_files(Script& script, const ModelCells* model) {
    InputFiles files;
    each_text_read(script, [&](Function function, const Node& text) {
        if (function == Function::field) {
            read_one(script, text, files);
        } else if (function == Function::image) {
            read_image(script, text, files);
        } else {
            CHECK(model != nullptr, "only scripts on models read what points and textures have");
            read_of_model(script, text, function, *model, files);
        }
    });
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return files;
}

}  // namespace cascade
