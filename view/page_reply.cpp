// Replies to the questions of pages. Each kind of question has a function.
#include "view/page_reply.h"

#include "core/base64.h"
#include "lang/equations/equations.h"
#include "lang/service/advice.h"
#include "lang/service/known_names.h"
#include "lang/service/name_index.h"
#include "measure/spectrum.h"
#include "picture/image.h"
#include "run/pictures/body_picture.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/measured.h"
#include "run/pictures/picture_size.h"
#include "run/session/changed_script.h"
#include "run/session/kept_state.h"
#include "run/session/session_picture.h"
#include "run/stage/stage_state.h"
#include "tissue/tissue.h"
#include "view/page_answer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace cascade {
namespace {

using Json = nlohmann::json;

constexpr std::size_t bins_of_histogram = 64, bins_of_density = 48;
constexpr std::int64_t most_cells_of_spectrum = std::int64_t{1} << 20;
/// The number of fixes is limited, because each fix requires a check of the whole text.
constexpr std::size_t most_fixes = 5;
constexpr std::size_t largest_fixed_text = std::size_t{1} << 16;

Json reply_to(const AskForLog&, LiveRun& run) {
    return {{"kind", "log"}, {"text", print_session_log(run.log())}};
}

Json reply_to(const AskForNames& question, LiveRun& run) {
    Json names = Json::array();
    const std::string& text = question.text;
    for (const KnownName& known : completions(text, text.size(), *run.script().program)) {
        names.push_back(
            {{"name", known.name}, {"what", name_of(known.kind)}, {"note", known.note}});
    }
    return {{"kind", "names"}, {"names", std::move(names)}};
}

Formula formula_of_item(ItemId item) {
    Formula formula;
    formula.nodes.push_back({item});
    return formula;
}

/// The present values of an item, with NaN outside the mask. The values of crawling cells form one
/// row.
Field values_of(const LiveRun& run, StageItem at) {
    Field values = std::move(run.simulation().evaluate(formula_of_item(at.item), at.stage)[0]);
    const Tissue* const cells = run.simulation().state(at.stage).tissue();
    return cells != nullptr ? row_of_cells(values, *cells) : std::move(values);
}

/// The grid on which the values of a stage lie. Crawling cells form one row.
Grid grid_of(const LiveRun& run, std::uint32_t stage) {
    const auto cells = counts_of_cells(run.simulation().state(stage));
    if (!cells) return run.simulation().domain().grid;
    return Grid{std::max<std::int64_t>(cells->count, 1), 1};
}

/// Adds the present value of an item if it is the same in all cells, and otherwise the range of its
/// values.
void add_values(Json& reply, const LiveRun& run, StageItem at) {
    const StageState& state = run.simulation().state(at.stage);
    if (!state.started) return;
    if (run.script().program->stages[at.stage].uniform[at.item]) {
        reply["value"] = state.numbers[at.item];
        return;
    }
    const Spread spread = spread_of(values_of(run, at));
    if (spread.count == 0) return;
    reply["smallest"] = spread.smallest;
    reply["largest"] = spread.largest;
}

Json reply_to(const AskAboutName& question, LiveRun& run) {
    const Script& script = run.script();
    const std::uint32_t stage = run.place().stage;
    const auto found = mention(question.text, question.text.size(), *script.program, stage);
    Json reply = {{"kind", "explanation"}};
    if (!found) return reply;
    const KnownName& known = found->known;
    reply["name"] = known.name;
    reply["what"] = name_of(known.kind);
    reply["note"] = known.note;
    const std::uint32_t of = found->item ? found->item->stage : stage;
    if (found->item) {
        add_values(reply, run, *found->item);
        const System& system = script.program->system_of(of);
        if (const auto& range = system.quantities[found->item->item].range) {
            reply["range"] = {range->low, range->high};
        }
    }
    if (found->item || known.kind == NameKind::definition) {
        reply["equation"] = equation_in_mathml(script.tree, script.sources,
                                               script.program->system_of(of).name, known.name);
    }
    return reply;
}

/// The time since the first stage began.
double time_of_run(const LiveRun& run) {
    double time = time_of(run.simulation(), run.place().stage);
    for (std::uint32_t k = 0; k < run.place().stage; ++k) time += run.simulation().state(k).t;
    return time;
}

Json reply_to(const AskForValues& question, LiveRun& run) {
    const std::uint32_t stage = run.place().stage;
    const System& system = run.script().program->system_of(stage);
    const Grid grid = grid_of(run, stage);
    Json species = Json::array();
    for (const ItemId item : system.species()) {
        if (system.cells && system.cells->has_component(item)) continue;
        const Field field = values_of(run, {stage, item});
        const Spread spread = spread_of(field);
        species.push_back({{"name", system.item_name(item)},
                           {"mean", spread.mean},
                           {"smallest", spread.smallest},
                           {"largest", spread.largest}});
        if (question.cell < 0 || question.cell >= grid.cell_count()) continue;
        species.back()["value"] = field.visit([&](const auto& plane) {
            return static_cast<double>(
                plane.row(question.cell / grid.width)[question.cell % grid.width]);
        });
    }
    return {{"kind", "values"},
            {"t", time_of_run(run)},
            {"stage", stage + 1},
            {"steps", run.place().steps},
            {"species", std::move(species)}};
}

/// Sorts numbers into `count` bins of equal width.
class Bins {
public:
    Bins(const Spread& spread, std::size_t count)
        : low_(spread.smallest),
          width_((spread.largest - spread.smallest) / static_cast<double>(count)),
          count_(count) {}
    /// The bin of a finite number, which must be within the spread of all numbers.
    std::size_t operator()(double value) const {
        const double place = width_ > 0 ? (value - low_) / width_ : 0;
        return std::min(static_cast<std::size_t>(std::max(place, 0.0)), count_ - 1);
    }

private:
    double low_, width_;
    std::size_t count_;
};

void add_spectrum(Json& reply, const measure::Samples& samples) {
    const measure::Spectrum spectrum = measure::radial_spectrum(samples);
    reply["spectrum"] = spectrum.power;
    reply["ring_width"] = spectrum.ring_width;
    reply["wavelength"] = measure::peak_wavelength(spectrum);
}

/// Replies with the distribution and the spectrum. Fails if a name is not a species of the present
/// stage.
Json reply_to(const AskForMeasures& question, LiveRun& run) {
    Json reply = {{"kind", "measures"}};
    const Simulation& simulation = run.simulation();
    const std::uint32_t stage = run.place().stage;
    const System& system = run.script().program->system_of(stage);
    const Grid grid = grid_of(run, stage);
    const auto x = find_item(system, question.x), y = find_item(system, question.y);
    if (!x || !y || !system.is_species(*x) || !system.is_species(*y)) return reply;
    const Field fields[] = {values_of(run, {stage, *x}), values_of(run, {stage, *y})};
    const Spread spreads[] = {spread_of(fields[0]), spread_of(fields[1])};
    if (spreads[0].count == 0 || spreads[1].count == 0) return reply;
    const measure::Samples samples[] = {measure::to_samples(fields[0], grid),
                                        measure::to_samples(fields[1], grid)};
    std::vector<int> histogram(bins_of_histogram), density(bins_of_density * bins_of_density);
    const Bins bins(spreads[0], bins_of_histogram);
    const Bins columns(spreads[0], bins_of_density), rows(spreads[1], bins_of_density);
    for (std::size_t k = 0; k < samples[0].count(); ++k) {
        const double first = samples[0].values[k], second = samples[1].values[k];
        if (!std::isfinite(first) || !std::isfinite(second)) continue;
        ++histogram[bins(first)];
        ++density[rows(second) * bins_of_density + columns(first)];
    }
    reply["histogram"] = histogram;
    reply["density"] = density;
    for (const std::size_t k : {0, 1}) {
        reply[k == 0 ? "x" : "y"] = {spreads[k].smallest, spreads[k].largest};
    }
    // Models and crawling cells have no rows and columns from which a spectrum could be computed.
    // The spectrum of a large field would stop the run for too long.
    const bool is_small = grid.cell_count() <= most_cells_of_spectrum;
    if (is_small && !simulation.domain().model && !system.cells) add_spectrum(reply, samples[0]);
    return reply;
}

Json reply_to(const AskForFeatures& question, LiveRun& run) {
    PictureRequest request;
    request.show = question.show;
    auto painter = make_painter(run, request);
    if (!painter) return Json::parse(print_answer(0, tl::unexpected(painter.error()), ""));
    Json features = Json::object();
    const auto values = measure::to_array(measure_shown(*painter, run.simulation()));
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isfinite(values[k]))
            features[std::string(measure::feature_names()[k])] = values[k];
    }
    return {{"kind", "features"}, {"features", std::move(features)}};
}

Json reply_to(const AskForFixes& question, LiveRun& run) {
    Json fixes = Json::array();
    if (question.text.size() > largest_fixed_text) return {{"kind", "fixes"}, {"fixes", fixes}};
    const Script faulty = with_text(run.script(), question.text);
    for (const Diagnostic& diagnostic : faulty.diagnostics.sorted()) {
        if (diagnostic.severity != Severity::error) continue;
        const bool is_own = faulty.sources[diagnostic.span.source].text() == faulty.text;
        const auto check = [&](const std::string& text) {
            return with_text(run.script(), text).diagnostics;
        };
        const auto fix =
            is_own ? fix_of(diagnostic, faulty.text, faulty.diagnostics, check) : std::nullopt;
        fixes.push_back(fix ? Json(*fix) : Json());
        if (fixes.size() == most_fixes) break;
    }
    return {{"kind", "fixes"}, {"fixes", std::move(fixes)}};
}

Json reply_to(const AskForPicture& question, LiveRun& run) {
    PictureRequest request = question.request;
    // The page shows a volume as slices, so its picture shows slices, too.
    request.flat = request.flat || draws_body(run.script(), request);
    auto png = session_picture(run, request);
    if (png) return {{"kind", "picture"}, {"png", base64(*png)}};
    return Json::parse(print_answer(0, tl::unexpected(std::move(png.error())), ""));
}

/// A text of the page, read as the script of the run.
class ReadText {
public:
    ReadText(const LiveRun& run, const std::string& text, std::size_t byte)
        : script_(with_text(run.script(), text)),
          index_(script_.tree, script_.diagnostics, script_.sources, own_source),
          byte_(static_cast<std::uint32_t>(std::min(byte, text.size()))) {}

    Json uses() const {
        Json list = Json::array();
        for (const Span use : index_.uses_at(byte_)) {
            if (use.source == own_source) list.push_back(place_of(use));
        }
        return list;
    }

    /// The position of the declaration in the text, or the name of the other source that contains
    /// it.
    Json declaration() const {
        const auto span = index_.declaration_at(byte_);
        if (!span) return nullptr;
        if (span->source == own_source) return place_of(*span);
        return {{"source", script_.sources[span->source].name()}};
    }

    std::string name() const {
        const auto span = index_.name_at(byte_);
        return span ? std::string(script_.sources.text(*span)) : std::string();
    }

    Result<std::string> renamed(const std::string& name) const {
        return index_.renamed(byte_, name);
    }

private:
    static constexpr SourceId own_source = 0;

    Json place_of(Span span) const {
        return {{"from", place_in_text(script_.text, span.begin)},
                {"to", place_in_text(script_.text, span.end)}};
    }

    Script script_;
    NameIndex index_;
    std::uint32_t byte_;
};

Json reply_to(const AskForUses& question, LiveRun& run) {
    const ReadText read(run, question.text, question.byte);
    return {{"kind", "uses"},
            {"name", read.name()},
            {"declaration", read.declaration()},
            {"uses", read.uses()}};
}

Json reply_to(const AskToRename& question, LiveRun& run) {
    const auto text = ReadText(run, question.text, question.byte).renamed(question.name);
    if (!text) return Json::parse(print_failure(0, text.error()));
    return {{"kind", "renamed"}, {"text", *text}};
}

}  // namespace

std::string print_reply(std::uint64_t id, const PageQuestion& question, LiveRun& run) {
    const auto begun = std::chrono::steady_clock::now();
    Json reply = std::visit([&run](const auto& asked) { return reply_to(asked, run); }, question);
    reply["id"] = id;
    reply["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    // Texts of users may contain bytes that are not UTF-8.
    return reply.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cascade
