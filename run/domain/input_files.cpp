// Reads every file only once, through GrantedFiles, which refuses files that the script may not
// read. Errors are reported at the file's name in the script.
#include "run/domain/input_files.h"

#include "core/check.h"
#include "core/printable.h"
#include "core/resample.h"
#include "lang/program/models.h"
#include "picture/grey_picture.h"
#include "picture/npy.h"
#include "run/domain/cell_carrier.h"
#include "run/domain/file_places.h"
#include "run/domain/surface_values.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>

namespace cascade {

namespace {

TextId text_of(const Node& node) { return std::get<TextId>(node.kind); }

/// Reads and parses a file that the script names.
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

/// Reads the numbers of a NumPy file. If that fails, adds an error to the script's diagnostics and
/// returns an empty optional.
std::optional<NpyArray> read_array(Script& script, const Node& node) {
    const std::string& name = script.program->literals->text(text_of(node));
    auto array = read_granted(script, name, largest_npy_file, [&](std::string_view bytes) {
        return parse_npy(bytes, script.program->domain.precision);
    });
    if (array) return *std::move(array);
    script.diagnostics.error(node.span, array.error().message, array.error().hint);
    return std::nullopt;
}

/// Returns whether an array has as many rows and columns as the grid. If not, adds an error to the
/// script's diagnostics.
bool fits_grid(Script& script, const Node& node, const NpyArray& array, const Grid& grid) {
    const std::string& name = script.program->literals->text(text_of(node));
    if (fits(array, grid)) return true;
    script.diagnostics.error(
        node.span,
        array.slices == 1 && grid.depth == 1
            ? fmt::format("'{}' has {} rows and {} columns, but the grid has {} and {}", name,
                          array.rows, array.columns, grid.height, grid.width)
            : fmt::format("'{}' has {} slices, {} rows and {} columns, but the grid has {}, "
                          "{} and {}",
                          name, array.slices, array.rows, array.columns, grid.depth, grid.height,
                          grid.width),
        array.slices == 1 ? fmt::format("a grid of {}, {} would fit", array.columns, array.rows)
                          : fmt::format("a grid of {}, {}, {} would fit", array.columns, array.rows,
                                        array.slices));
    return false;
}

/// Reads a channel of a PNG file. If that fails, adds an error to the script's diagnostics and
/// returns an empty optional.
std::optional<GreyPicture> read_picture(Script& script, const Node& node, PictureChannel channel) {
    const std::string& name = script.program->literals->text(text_of(node));
    auto picture = read_granted(script, name, largest_picture_file, [&](std::string_view bytes) {
        return parse_grey_picture(bytes, channel);
    });
    if (picture) return *std::move(picture);
    script.diagnostics.error(node.span, picture.error().message, picture.error().hint);
    return std::nullopt;
}

/// Reads the files that a script names, for its grid or its model.
class FileReader {
public:
    FileReader(Script& script, const ModelCells* model)
        : script_(script), model_(model), grid_(script.program->domain.grid) {}

    /// Makes a plane from a file. If that fails, adds an error to the script's diagnostics and
    /// returns an empty optional.
    std::optional<Field> read(const NamedPlane& name, const Node& text) const {
        const FileReading& reading = script_.program->literals->reading(name.reading);
        switch (name.function) {
            case Function::attr: return attribute(text);
            case Function::field: return array(reading, text);
            default: return reading.is_direction ? angles(reading, text) : image(reading, text);
        }
    }

    /// Reads a file for the kernel of a convolution. If that fails, adds an error to the script's
    /// diagnostics and returns an empty optional.
    std::optional<KernelFile> read_kernel(const NamedPlane& name, const Node& text) const {
        const FileReading& reading = script_.program->literals->reading(name.reading);
        if (name.function == Function::image) {
            const auto picture = read_picture(script_, text, reading.channel);
            if (!picture) return std::nullopt;
            return KernelFile(*picture, reading.place);
        }
        const auto array = read_array(script_, text);
        if (!array || !knows_slices(*array, reading, text)) return std::nullopt;
        return KernelFile(*array, reading.place);
    }

private:
    /// Returns whether it is clear which slice of an array is read. If the array has several slices
    /// and the position has no slice, adds an error to the script's diagnostics.
    bool knows_slices(const NpyArray& array, const FileReading& reading, const Node& text) const {
        if (array.slices == 1 || reading.place.size() == 3) return true;
        script_.diagnostics.error(
            text.span,
            fmt::format("'{}' has {} slices, but the position has only two numbers",
                        script_.program->literals->text(text_of(text)), array.slices),
            "add a third number, from 0 to 1, for a point between the first and the last slice");
        return false;
    }

    std::optional<Field> or_error(Result<Field> plane, const Node& text) const {
        if (plane) return *std::move(plane);
        script_.diagnostics.error(text.span, plane.error().message, plane.error().hint);
        return std::nullopt;
    }

    std::optional<Field> attribute(const Node& text) const {
        CHECK(model_ != nullptr, "only scripts on models read what points have");
        const std::string& name = script_.program->literals->text(text_of(text));
        return or_error(attribute_plane(name, *model_, precision()), text);
    }

    std::optional<Field> array(const FileReading& reading, const Node& text) const {
        const auto array = read_array(script_, text);
        if (!array) return std::nullopt;
        if (reading.place.empty()) {
            const std::int64_t detail = script_.program->domain.detail;
            const Grid grid = coarser(grid_, detail);
            if (!fits_grid(script_, text, *array, grid)) return std::nullopt;
            Field values = to_field(*array, precision());
            if (detail == 1) return values;
            return carrier_to_finer(grid, detail, nullptr, nullptr)->carried(values);
        }
        if (!knows_slices(*array, reading, text)) return std::nullopt;
        const auto places = FilePlaces::by_formulas(reading.place, grid_, model_, false);
        return plane(places.numbers(*array));
    }

    std::optional<Field> image(const FileReading& reading, const Node& text) const {
        const auto picture = read_picture(script_, text, reading.channel);
        if (!picture) return std::nullopt;
        if (reading.place.empty() && model_ == nullptr) {
            const Field filled = to_field(resized(*picture, grid_.width, grid_.height), grid_);
            return filled.converted(precision());
        }
        const auto places = places_of(reading, text);
        if (!places) return std::nullopt;
        return plane(places->numbers(*picture));
    }

    std::optional<Field> angles(const FileReading& reading, const Node& text) const {
        const auto red = read_picture(script_, text, PictureChannel::red);
        if (!red) return std::nullopt;
        const auto green = read_picture(script_, text, PictureChannel::green);
        const auto places = places_of(reading, text);
        if (!green || !places) return std::nullopt;
        return plane(places->angles(*red, *green));
    }

    std::optional<FilePlaces> places_of(const FileReading& reading, const Node& text) const {
        if (!reading.place.empty()) {
            return FilePlaces::by_formulas(reading.place, grid_, model_, reading.is_direction);
        }
        if (model_ == nullptr) return FilePlaces::of_grid(grid_);
        auto places =
            FilePlaces::of_texture(*model_, *script_.program->domain.model, reading.is_direction);
        if (places) return *std::move(places);
        script_.diagnostics.error(text.span, places.error().message, places.error().hint);
        return std::nullopt;
    }

    Field plane(const std::vector<double>& numbers) const {
        return plane_of(numbers, grid_, model_, precision());
    }
    Precision precision() const { return script_.program->domain.precision; }

    Script& script_;
    const ModelCells* model_;
    const Grid& grid_;
};

/// Calls `read(name, text)` for each file name that a formula contains, unless the name is already
/// in `known`.
template <typename Read>
void each_text_of(const Formula& formula, std::set<NamedPlane>& known, const Read& read) {
    for (const Node& node : formula.nodes) {
        if (!node.is<Call>() || !reads_file(node.function)) continue;
        const Node& text = formula.nodes[node.operands[0]];
        const NamedPlane name{node.function, text_of(text), node.as<Call>()->detail};
        if (known.insert(name).second) read(name, text);
    }
}

/// Calls `read(name, text)` for each file name in the kernels of convolutions.
template <typename Read>
void each_kernel_file(const Script& script, const Read& read) {
    std::set<NamedPlane> known;
    for (const Formula* formula : formulas_of(*script.program)) {
        for_each_kernel(*formula, *script.program->literals, [&](const ConvolutionKernel& kernel) {
            each_text_of(kernel.weight, known, read);
        });
    }
}

/// Calls `read(name, text)` once for each file name in the script's formulas.
template <typename Read>
void each_text_read(const Script& script, const Read& read) {
    std::set<NamedPlane> known;
    const auto read_of = [&](const Formula& formula) { each_text_of(formula, known, read); };
    if (script.program->domain.mask) read_of(script.program->domain.mask->formula);
    for (const Formula* formula : formulas_of(*script.program)) read_of(*formula);
}

}  // namespace

std::map<std::string, std::set<PictureChannel>> input_files_of(const Script& script) {
    std::map<std::string, std::set<PictureChannel>> files;
    const auto take = [&](const NamedPlane& plane, const Node& text) {
        if (plane.function == Function::attr) return;
        auto& channels = files[script.program->literals->text(text_of(text))];
        if (plane.function != Function::image) return;
        const FileReading& reading = script.program->literals->reading(plane.reading);
        if (!reading.is_direction) channels.insert(reading.channel);
        else channels.insert({PictureChannel::red, PictureChannel::green});
    };
    each_text_read(script, take);
    each_kernel_file(script, take);
    return files;
}

Result<void> check_attributes(Script& script, const SurfaceMesh& mesh) {
    each_text_read(script, [&](const NamedPlane& plane, const Node& text) {
        if (plane.function != Function::attr) return;
        const auto found = find_attribute(script.program->literals->text(text_of(text)), mesh);
        if (!found) script.diagnostics.error(text.span, found.error().message, found.error().hint);
    });
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return {};
}

Result<InputFiles> read_input_files(Script& script, const ModelCells* model) {
    InputFiles files;
    const FileReader reader(script, model);
    each_text_read(script, [&](const NamedPlane& name, const Node& text) {
        if (auto plane = reader.read(name, text)) files.add(name, *std::move(plane));
    });
    each_kernel_file(script, [&](const NamedPlane& name, const Node& text) {
        if (auto kernel = reader.read_kernel(name, text))
            files.add_kernel(name, *std::move(kernel));
    });
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return files;
}

}  // namespace cascade
