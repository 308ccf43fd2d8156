// Reads a pattern of Ready: an XML file of VTK with a formula, parameters, a way to begin, and the
// values of all cells.
#include "import/ready.h"

#include "picture/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cascade::importing {

namespace {

constexpr double most_ready_chemicals = 100;

/// The numbers of cells of a pattern on a grid.
bool read_cells(ReadyPattern& pattern, const pugi::xml_node& image) {
    Import& import = pattern.import;
    std::array<std::int64_t, 6> extent{};
    std::string_view text = image.attribute("WholeExtent").value();
    for (std::int64_t& each : extent) {
        while (text.starts_with(' ')) text.remove_prefix(1);
        const std::string_view word = text.substr(0, text.find(' '));
        const auto value = plain_number(word);
        if (!value || std::abs(*value) > 1e9) {
            import.diagnostics.error(place_of(import, image),
                                     "the attribute WholeExtent needs six whole numbers");
            return false;
        }
        each = static_cast<std::int64_t>(*value);
        text.remove_prefix(word.size());
    }
    std::int64_t all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t count = extent[2 * axis + 1] - extent[2 * axis] + 1;
        if (count < 1 || count > most_imported_cells || all * count > most_imported_cells) {
            import.diagnostics.error(place_of(import, image),
                                     fmt::format("a domain of 1 to {} cells is expected",
                                                 most_imported_cells));
            return false;
        }
        pattern.cells[axis] = count;
        all *= count;
    }
    if (pattern.axes() > 0) return true;
    import.diagnostics.error(place_of(import, image), "the domain has a single cell");
    return false;
}

/// The comment at the top of the script: the type of the pattern and its description, without HTML
/// tags.
std::vector<std::string> description_of(const Import& import, const pugi::xml_node& rd) {
    const std::string title = plain_line(unescaped(rd.child("rule").attribute("name").value()));
    std::vector<std::string> lines = {fmt::format("{}, imported from a pattern of Ready: {}",
                                                  title.empty() ? "Pattern" : title,
                                                  plain_line(import.name))};
    std::string text = unescaped(rd.child("description").child_value());
    std::string plain;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool is_mark =
            text[at] == '<' && at + 1 < text.size() &&
            (std::isalpha(static_cast<unsigned char>(text[at + 1])) || text[at + 1] == '/');
        if (is_mark) {
            const std::size_t end = text.find('>', at);
            plain += ' ';
            at = end == std::string::npos ? text.size() : end;
        } else {
            plain += text[at];
        }
    }
    plain = plain_line(plain);
    if (plain.size() > 600) plain = plain.substr(0, plain.rfind(' ', 600)) + " …";
    if (!plain.empty()) lines.push_back(plain);
    return lines;
}

bool read_parameters(ReadyPattern& pattern, const pugi::xml_node& rule) {
    Import& import = pattern.import;
    for (const pugi::xml_node& parameter : rule.children("param")) {
        const std::string name = plain_line(unescaped(parameter.attribute("name").value()));
        const auto value = plain_number(parameter.child_value());
        if (name.empty() || !value) {
            import.diagnostics.error(place_of(import, parameter),
                                     "a parameter needs a name and a number");
            return false;
        }
        pattern.values[name] = *value;
        if (name == "timestep" || name == "dx") continue;
        pattern.parameters[name] = pattern.names.declare(name);
    }
    return true;
}

/// Stores the values of a species in the file as a NumPy array beside the script.
std::optional<std::string> store_species(const ReadyPattern& pattern, const VtkFile& file,
                                         const pugi::xml_node& data, std::size_t species,
                                         Draft& draft) {
    const auto [width, height, depth] = pattern.cells;
    const std::string name = ready_chemical(species);
    const pugi::xml_node array = data.find_child_by_attribute("DataArray", "Name", name.c_str());
    if (!array) {
        pattern.import.diagnostics.error(place_of(pattern.import, data),
                                         fmt::format("the file has no values of '{}'", name));
        return std::nullopt;
    }
    const auto values = file.numbers(array, static_cast<std::uint64_t>(width * height * depth));
    if (!values) return std::nullopt;
    const bool is_same = std::all_of(values->begin(), values->end(),
                                     [&](double each) { return each == values->front(); });
    if (is_same && std::isfinite(values->front())) return number_text(values->front());
    std::string shape = fmt::format("{}, {}", height, width);
    if (height == 1 && depth == 1) shape = fmt::format("{},", width);
    if (depth > 1) shape = fmt::format("{}, {}, {}", depth, height, width);
    FileBeside beside{fmt::format("{}_{}.npy", pattern.import.stem, pattern.species[species]),
                      npy_head("<f4", shape)};
    for (std::int64_t k = 0; k < depth; ++k) {
        for (std::int64_t j = height - 1; j >= 0; --j) {  // Ready's rows begin at the bottom.
            for (std::int64_t i = 0; i < width; ++i) {
                const auto value = static_cast<float>(
                    (*values)[static_cast<std::size_t>((k * height + j) * width + i)]);
                char bytes[sizeof value];
                std::memcpy(bytes, &value, sizeof value);
                beside.bytes.append(bytes, sizeof value);
            }
        }
    }
    draft.files.push_back(std::move(beside));
    return fmt::format("field(\"{}\")", draft.files.back().name);
}

/// Whether the file's overlays, and not its values, give the starting values.
bool begins_with_overlays(const pugi::xml_node& generator) {
    return generator &&
           std::string_view(generator.attribute("apply_when_loading").as_string("true")) == "true";
}

bool add_start(ReadyPattern& pattern, const VtkFile& file, const pugi::xml_node& rd,
               const pugi::xml_node& image, Draft& draft) {
    const pugi::xml_node generator = rd.child("initial_pattern_generator");
    const bool is_made = begins_with_overlays(generator);
    const bool is_blank =
        std::string_view(generator.attribute("zero_first").as_string("true")) != "false";
    std::vector<std::string> stored(pattern.species.size(), "0");
    if (!is_made || !is_blank) {
        const pugi::xml_node data = image.child("Piece").child("PointData");
        for (std::size_t k = 0; k < stored.size(); ++k) {
            const auto value = store_species(pattern, file, data, k, draft);
            if (!value) return false;
            stored[k] = *value;
        }
    }
    if (is_made) return add_ready_start(pattern, generator, stored, draft);
    for (std::size_t k = 0; k < stored.size(); ++k) {
        draft.starts.push_back(fmt::format("{}: {}", pattern.species[k], stored[k]));
    }
    return true;
}

/// The stencil of the domain. Ready takes its Laplacians from Patra and Karttunen (2006).
std::string stencil_of(const ReadyPattern& pattern, const pugi::xml_node& formula, Draft& draft) {
    const std::string_view accuracy = formula.attribute("accuracy").as_string("medium");
    const std::string text = formula.child_value();
    const bool has_laplacian = text.find("laplacian_") != std::string::npos;
    if (pattern.axes() == 1) return accuracy == "high" ? "fourth" : "";
    const std::size_t before = draft.remarks.size();
    const auto says_other = [&](std::string_view name, std::string_view own) {
        if (pattern.has_nine_cells || text.find(std::string(name) + "_") == std::string::npos)
            return;
        draft.remarks.push_back(
            fmt::format("Ready's {} has its own stencil; here it is {}.", name, own));
        draft.has_other_differences = true;
    };
    says_other("bilaplacian", "lap(lap(…))");
    says_other("trilaplacian", "lap(lap(lap(…)))");
    if (pattern.axes() == 2 && accuracy == "low") return "";
    if (has_laplacian && pattern.axes() == 3) {
        draft.remarks.push_back(
            "Ready's Laplacian reads 27 cells, this one 19; both have the same order and no "
            "preferred direction.");
    } else if (has_laplacian && accuracy == "high") {
        draft.remarks.push_back("Ready's Laplacian of high accuracy reads 21 cells, this one 9.");
    }
    draft.has_other_differences = draft.remarks.size() > before;
    return "isotropic";
}

}  // namespace

std::string ready_chemical(std::size_t index) {
    std::string name;
    if (index >= 26) name += static_cast<char>('a' + index / 26 - 1);
    return name + static_cast<char>('a' + index % 26);
}

std::optional<std::size_t> ready_chemical_number(std::string_view name, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        if (ready_chemical(k) == name) return k;
    }
    return std::nullopt;
}

/// Declares the chemicals. Reports an error if their number is wrong.
static bool read_species(ReadyPattern& pattern, Import& import, const pugi::xml_node& formula) {
    const auto count = number_attribute(import, formula, "number_of_chemicals");
    if (!count) return false;
    if (*count < 1 || *count > most_ready_chemicals || *count != std::floor(*count)) {
        import.diagnostics.error(place_of(import, formula), "1 to 100 chemicals are expected", "");
        return false;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(*count); ++k) {
        pattern.species.push_back(pattern.names.declare(ready_chemical(k)));
    }
    return true;
}

/// The statements of the domain.
static std::vector<std::string> domain_of(ReadyPattern& pattern) {
    const auto [width, height, depth] = pattern.cells;
    std::string grid = fmt::format("grid: {}", width);
    if (height > 1 || depth > 1) grid += fmt::format(", {}", height);
    if (depth > 1) grid += fmt::format(", {}", depth);
    std::vector<std::string> statements{grid};
    if (pattern.has_spacing()) {
        statements.push_back("spacing: " + number_text(pattern.values["dx"]));
    }
    statements.emplace_back(pattern.is_periodic ? "boundary: periodic" : "boundary: noflux");
    return statements;
}

std::optional<Draft> read_ready(Import& import) {
    pugi::xml_document document;
    const auto file = VtkFile::read(import, document);
    if (!file) return std::nullopt;
    const pugi::xml_node rd = file->root().child("RD");
    const pugi::xml_node rule = rd.child("rule");
    const auto refuse = [&](const pugi::xml_node& place, const std::string& why,
                            const std::string& hint = "") -> std::optional<Draft> {
        import.diagnostics.error(place_of(import, place ? place : file->root()), why, hint);
        return std::nullopt;
    };
    if (!rule) return refuse(rd, "this file has no rule of Ready");
    const std::string_view type = rule.attribute("type").value();
    if (type != "formula") {
        return refuse(rule,
                      fmt::format("this rule of the type '{}' is a program, not a formula",
                                  plain_line(type)),
                      "only rules of the type 'formula' can be imported");
    }
    if (const pugi::xml_node mesh = file->root().child("UnstructuredGrid")) {
        return refuse(mesh, "patterns of Ready on meshes (.vtu) cannot be imported",
                      "save the mesh as a model and use 'domain { mesh: … }'");
    }
    const pugi::xml_node image = file->root().child("ImageData");
    if (!image) return refuse(file->root(), "the file has no <ImageData>");

    ReadyPattern pattern{import};
    const pugi::xml_node formula = rule.child("formula");
    if (!read_species(pattern, import, formula)) return std::nullopt;
    pattern.is_periodic = std::string_view(rule.attribute("wrap").as_string("1")) == "1";
    Draft draft;
    draft.about = description_of(import, rd);
    const bool has_cells = read_cells(pattern, image);
    pattern.has_nine_cells =
        pattern.axes() == 2 &&
        std::string_view(formula.attribute("accuracy").as_string("medium")) != "low";
    const bool is_read = has_cells && read_parameters(pattern, rule) &&
                         add_start(pattern, *file, rd, image, draft) &&
                         add_ready_formula(pattern, formula, draft);
    if (!is_read) return std::nullopt;

    draft.domain = domain_of(pattern);
    if (const std::string stencil = stencil_of(pattern, formula, draft); !stencil.empty()) {
        draft.domain.push_back("stencil: " + stencil);
    }
    const auto step = pattern.values.find("timestep");
    draft.speed = step == pattern.values.end() ? 1 : step->second;
    if (!(draft.speed > 0)) return refuse(rule, "the timestep must be above 0");
    const pugi::xml_node settings = rd.child("render_settings");
    const auto shown =
        ready_chemical_number(settings.child("active_chemical").attribute("value").as_string("a"),
                              pattern.species.size());
    draft.stage = {"iterations: 2000", "show: " + pattern.species[shown.value_or(0)]};
    return draft;
}

}  // namespace cascade::importing
