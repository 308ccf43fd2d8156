// Prints texts with nlohmann-json, and appends planes as raw bytes.
#include "view/page_answer.h"

#include "core/palette.h"
#include "core/utf8.h"
#include "lang/print/library_note.h"
#include "picture/image.h"
#include "run/pictures/picture_size.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace cascade {
namespace {

using Json = nlohmann::json;
static_assert(std::endian::native == std::endian::little, "planes are sent as they lie in memory");

/// Prints JSON. Replaces bytes that are not UTF-8, which texts of users may contain.
std::string print(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Prints diagnostics. Positions outside of `text`, such as in an option, are left out.
Json print_diagnostics(const Diagnostics& diagnostics, const Sources& sources,
                       std::string_view text) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        Json one = {{"is_error", diagnostic.severity == Severity::error},
                    {"message", diagnostic.message},
                    {"hint", diagnostic.hint}};
        const Span span = diagnostic.span;
        if (sources[span.source].text() == text) {
            one["from"] = place_in_text(text, span.begin);
            one["to"] = place_in_text(text, span.end);
        }
        for (const Note& note : diagnostic.notes) one["notes"].push_back(note.message);
        list.push_back(std::move(one));
    }
    return list;
}

Json print_failure(const Failure& failure) {
    return {{"is_error", true}, {"message", failure.message}, {"hint", failure.hint}};
}

/// Prints the sliders for uniform parameters with a range, in stages that have begun. If several
/// stages have a parameter of the same name, the name of the stage is added.
Json print_controls(const LiveRun& run) {
    Json controls = Json::array();
    const Program& program = *run.script().program;
    for (std::uint32_t k = 0; k < run.script().stage_count(); ++k) {
        const StageState& state = run.simulation().state(k);
        const System& system = program.system_of(k);
        for (const ItemId item : system.quantities.ids()) {
            const Quantity& quantity = system.quantities[item];
            if (!state.started || !quantity.range || !program.stages[k].uniform[item]) continue;
            controls.push_back({{"name", program.stages[k].name + "." + quantity.name},
                                {"label", quantity.name},
                                {"stage", k + 1},
                                {"doc", quantity.doc},
                                {"low", quantity.range->low},
                                {"high", quantity.range->high},
                                {"value", state.numbers[item]}});
            if (quantity.range->step) controls.back()["step"] = *quantity.range->step;
        }
    }
    return controls;
}

/// Prints the species of the current stage, beginning with the species that its pictures show.
Json print_species(const LiveRun& run) {
    Json names = Json::array();
    const Program& program = *run.script().program;
    const std::uint32_t stage = run.place().stage;
    const auto* const shown = program.stages[stage].show.nodes.back().as<ItemId>();
    const System& system = program.system_of(stage);
    for (const ItemId item : system.species()) {
        if (system.cells && system.cells->has_component(item)) continue;
        const auto place = shown != nullptr && item == *shown ? names.begin() : names.end();
        names.insert(place, std::string(system.item_name(item)));
    }
    return names;
}

/// Prints what brush strokes can do: change a species, or "remove" crawling cells.
Json print_brushes(const LiveRun& run) {
    Json names = print_species(run);
    if (run.script().program->system_of(run.place().stage).cells) names.push_back("remove");
    return names;
}

/// Prints the sizes of the arrays that describe cells.
Json print_cells(const ShownCells& cells) {
    std::size_t vertices = 0, triangles = 0;
    for (const TriangleMesh& mesh : cells.meshes) {
        vertices += mesh.positions.size();
        triangles += mesh.triangles.size();
    }
    Json json = {
        {"count", cells.count},   {"shapes", cells.meshes.size()},         {"vertices", vertices},
        {"triangles", triangles}, {"placements", cells.placements.size()}, {"skin", cells.skin}};
    json["is_flat"] = !cells.is_on_model;
    if (!cells.is_on_model && !cells.is_on_body) {
        json["extent"] = {cells.extent.x, cells.extent.y, cells.extent.z};
    }
    return json;
}

/// Prints the header of a snapshot. Infinity and NaN become null.
Json print_header(const Snapshot& snapshot) {
    Json stages = Json::array();
    for (const StageProgress& stage : snapshot.stages) {
        stages.push_back({{"name", stage.name},
                          {"steps", stage.steps},
                          {"iterations", stage.iterations},
                          {"t", stage.t},
                          {"duration", stage.duration},
                          {"has_begun", stage.has_begun},
                          {"has_ended", stage.has_ended}});
        if (!stage.cells) continue;
        stages.back()["cells"] = {{"count", stage.cells->count},
                                  {"births", stage.cells->births},
                                  {"deaths", stage.cells->deaths}};
    }
    const PlaneLayout& layout = snapshot.fields[0].layout();
    const ValueRange range =
        snapshot.fields.size() == 1 ? automatic_range(spread_of(snapshot.fields[0])) : ValueRange();
    Json header = {{"kind", "snapshot"},
                   {"number", snapshot.number},
                   {"surface", snapshot.surface_number},
                   {"is_model", snapshot.model != nullptr},
                   {"script", snapshot.script},
                   {"is_going_on", snapshot.is_going_on},
                   {"stage", snapshot.place.stage + 1},
                   {"steps", snapshot.place.steps},
                   {"stages", std::move(stages)},
                   {"steps_per_second", snapshot.steps_per_second},
                   {"can_undo", snapshot.can_undo},
                   {"can_redo", snapshot.can_redo},
                   {"failure", snapshot.failure},
                   {"remarks", snapshot.remarks},
                   {"columns", layout.width},
                   {"rows", layout.row_count()},
                   {"repeats", sides_that_repeat(snapshot.grid, snapshot.slice)},
                   {"fields", snapshot.fields.size()},
                   {"low", range.low},
                   {"high", range.high}};
    if (const auto [across, down] = snapshot.scales; across != down)
        header["cell"] = {across * snapshot.grid.spacing, down * snapshot.grid.spacing};
    if (snapshot.cells) {
        header["cells"] = print_cells(*snapshot.cells);
    } else if (const Grid& grid = snapshot.grid; grid.depth > 1) {
        header["slice"] = {{"axis", name_of(snapshot.slice.axis)},
                           {"number", slice_number(PlaneLayout(grid), snapshot.slice)},
                           {"sides", {grid.width, grid.height, grid.depth}}};
    }
    return header;
}

/// Begins a frame with its header, and reserves room for `more` bytes.
std::string begin_frame(const Json& json, std::size_t more) {
    std::string header = print(json);
    header.resize((header.size() + 3) / 4 * 4, ' ');
    const auto size = static_cast<std::uint32_t>(header.size());
    std::string bytes;
    bytes.reserve(sizeof size + header.size() + more);
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes += header;
    return bytes;
}

template <typename Element>
void append(const std::vector<Element>& elements, std::string& bytes) {
    static_assert(sizeof(Element) % 4 == 0 && std::is_trivially_copyable_v<Element>);
    bytes.append(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element));
}

/// Appends the meshes one after the other, and then the copies of each mesh.
void append_cells(const ShownCells& cells, std::string& bytes) {
    for (const TriangleMesh& mesh : cells.meshes) append(mesh.positions, bytes);
    for (const TriangleMesh& mesh : cells.meshes) append(mesh.normals, bytes);
    for (const TriangleMesh& mesh : cells.meshes) {
        std::vector<float> shades = mesh.shades;
        shades.resize(mesh.positions.size(), 1);
        append(shades, bytes);
    }
    std::uint32_t before = 0;
    std::vector<std::uint32_t> ends;
    for (const TriangleMesh& mesh : cells.meshes) {
        auto triangles = mesh.triangles;
        for (auto& corners : triangles) {
            for (std::uint32_t& corner : corners) corner += before;
        }
        append(triangles, bytes);
        before += static_cast<std::uint32_t>(mesh.positions.size());
        ends.push_back((ends.empty() ? 0 : ends.back()) +
                       static_cast<std::uint32_t>(triangles.size()));
    }
    append(ends, bytes);
    append(cells.ends, bytes);
    append(cells.cells, bytes);
    std::vector<std::array<float, 10>> placements;
    for (const Placement& each : cells.placements) {
        const std::array<double, 10> numbers{each.place.x, each.place.y, each.place.z, each.turn.x,
                                             each.turn.y,  each.turn.z,  each.turn.w,  each.scale.x,
                                             each.scale.y, each.scale.z};
        std::ranges::transform(numbers, placements.emplace_back().begin(),
                               [](double number) { return static_cast<float>(number); });
    }
    append(placements, bytes);
}

}  // namespace

std::string print_palettes() {
    Json list = Json::array();
    for (const Palette& palette : palettes()) {
        list.push_back({{"name", palette.name},
                        {"description", palette.description},
                        {"stops", palette.stops}});
    }
    return print({{"kind", "palettes"}, {"palettes", std::move(list)}});
}

std::string print_systems() {
    Json list = Json::array();
    for (const LibraryText& text : library_texts()) {
        const LibraryNote note = note_of(text);
        list.push_back({{"name", text.system_name()},
                        {"about", note.about},
                        {"words", note.words},
                        {"script", starting_script(text)}});
    }
    return print({{"kind", "systems"}, {"systems", std::move(list)}});
}

std::string print_script(const LiveRun& run) {
    const Script& script = run.script();
    return print({{"kind", "script"},
                  {"name", shown_name(script)},
                  {"text", script.text},
                  {"messages", print_diagnostics(script.diagnostics, script.sources, script.text)},
                  {"controls", print_controls(run)},
                  {"species", print_species(run)},
                  {"brushes", print_brushes(run)}});
}

std::uint64_t version_of_script(const Snapshot& snapshot) {
    const auto begun = std::count_if(snapshot.stages.begin(), snapshot.stages.end(),
                                     [](const StageProgress& stage) { return stage.has_begun; });
    return snapshot.script * 65536 + static_cast<std::uint64_t>(begun);
}

std::string print_answer(std::uint64_t id, const Accepted<void>& result, std::string_view text) {
    Json messages = Json::array();
    if (!result) {
        const Refusal& refusal = result.error();
        messages = print_diagnostics(refusal.diagnostics, refusal.sources, text);
        if (refusal.failure) messages.push_back(print_failure(*refusal.failure));
    }
    return print({{"kind", "answer"},
                  {"id", id},
                  {"is_done", result.has_value()},
                  {"messages", std::move(messages)}});
}

std::string print_failure(std::uint64_t id, const Failure& failure) {
    return print({{"kind", "answer"},
                  {"id", id},
                  {"is_done", false},
                  {"messages", Json::array({print_failure(failure)})}});
}

std::string print_engine(std::string_view name, std::string_view about) {
    return print(Json{{"kind", "engine"}, {"name", name}, {"about", about}});
}

std::string print_progress(const Progress& progress) {
    Json json = {{"kind", "progress"}, {"doing", progress.doing}};
    if (progress.steps > 0) {
        json["part"] = static_cast<double>(progress.step) / static_cast<double>(progress.steps);
    }
    return print(json);
}

std::string print_loaded(std::uint64_t id, const Result<std::string>& name) {
    if (!name) return print_failure(id, name.error());
    return print({{"kind", "loaded"}, {"id", id}, {"name", *name}});
}

std::string print_snapshot(const Snapshot& snapshot) {
    const PlaneLayout& layout = snapshot.fields[0].layout();
    const auto row_bytes = static_cast<std::size_t>(layout.width) * sizeof(float);
    const auto rows = static_cast<std::size_t>(layout.row_count());
    std::string bytes =
        begin_frame(print_header(snapshot), snapshot.fields.size() * rows * row_bytes);
    for (const Field& field : snapshot.fields) {
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            bytes.append(reinterpret_cast<const char*>(field.row(row)), row_bytes);
        }
    }
    if (snapshot.cells) append_cells(*snapshot.cells, bytes);
    return bytes;
}

std::string print_saved(std::uint64_t id, const SavedModel& saved) {
    const Json header = {{"kind", "file"},
                         {"id", id},
                         {"ending", saved.ending},
                         {"size", saved.bytes.size()},
                         {"notes", saved.notes}};
    std::string bytes = begin_frame(header, saved.bytes.size() + 3);
    bytes += saved.bytes;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
}

std::array<std::size_t, 2> place_in_text(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    const std::size_t start = before.rfind('\n') + 1;  // If there is no line break, npos + 1 is 0.
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return {static_cast<std::size_t>(line), count_utf16_units(before.substr(start))};
}

std::string print_surface(const ShownSurface& surface, std::uint64_t number) {
    static_assert(sizeof(Vector3) == 3 * sizeof(float) && sizeof(CellShare) == 8);
    const std::size_t vertices = surface.positions.size();
    const Json header = {{"kind", "surface"},
                         {"number", number},
                         {"up", name_of(surface.up)},
                         {"spacing", surface.spacing},
                         {"vertices", vertices},
                         {"places", surface.places.size()},
                         {"triangles", surface.triangles.size()},
                         {"shares", surface.shares.size()}};
    std::string bytes = begin_frame(header, 36 * vertices + 12 * surface.triangles.size() +
                                                8 * surface.shares.size());
    append(surface.positions, bytes);
    append(surface.normals, bytes);
    append(surface.places, bytes);
    append(surface.triangles, bytes);
    append(surface.ends, bytes);
    append(surface.shares, bytes);
    return bytes;
}

}  // namespace cascade
