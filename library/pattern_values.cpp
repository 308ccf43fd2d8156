// The part of the public library (include/cascade/cascade.h) that reads values and settings of a
// pattern.

#include "core/file.h"
#include "core/shared_plane.h"
#include "run/commands/analyze.h"
#include "run/commands/outlooks.h"
#include "library/pattern_state.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/measured.h"
#include "run/session/session_picture.h"
#include "run/simulation/end_remarks.h"
#include "tissue/tissue.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace cascade {
namespace {

/// The values of crawling cells in a single row, in ascending order of the cells' numbers and in
/// the run's precision.
Field row_in_order(const Field& field, const Tissue& cells) {
    const std::vector<double> values = number_order(field, cells);
    Grid grid;
    grid.width = static_cast<std::int64_t>(values.size());
    grid.height = 1;
    Field row(PlaneLayout(grid), field.precision());
    row.visit([&](auto& plane) {
        std::transform(values.begin(), values.end(), plane.origin(), [](double value) {
            return static_cast<std::remove_reference_t<decltype(*plane.origin())>>(value);
        });
    });
    return row;
}

PatternView view_of(const Field& field, std::shared_ptr<const void> owner) {
    PatternView view;
    const PlaneLayout& layout = field.layout();
    view.width = layout.width;
    view.height = layout.height;
    view.depth = layout.depth;
    const auto bytes = static_cast<std::int64_t>(bytes_of(field.precision()));
    view.row_bytes = layout.stride * bytes;
    view.slice_bytes = layout.slice_stride * bytes;
    view.number = field.precision() == Precision::single ? PatternView::Number::binary32
                                                         : PatternView::Number::binary64;
    view.data = field.visit([](const auto& plane) -> const void* { return plane.origin(); });
    view.owner = std::move(owner);
    return view;
}

template <typename Number, typename Stored>
void append_rows(const PatternView& view, std::vector<Number>& values) {
    for (std::int64_t slice = 0; slice < view.depth; ++slice) {
        for (std::int64_t row = 0; row < view.height; ++row) {
            const auto* const begin =
                reinterpret_cast<const Stored*>(static_cast<const char*>(view.data) +
                                                slice * view.slice_bytes + row * view.row_bytes);
            std::transform(begin, begin + view.width, std::back_inserter(values),
                           [](Stored value) { return static_cast<Number>(value); });
        }
    }
}

template <typename Number>
std::vector<Number> copied(const PatternView& view) {
    std::vector<Number> values;
    values.reserve(static_cast<std::size_t>(view.width * view.height * view.depth));
    if (view.number == PatternView::Number::binary32) append_rows<Number, float>(view, values);
    else append_rows<Number, double>(view, values);
    return values;
}

}  // namespace

const Formula* Pattern::Implementation::formula(const std::string& text) {
    // The key contains the stage, because the same text may have another meaning in another stage.
    const std::string key = current().name + ":" + text;
    if (const auto known = formulas.find(key); known != formulas.end()) return &known->second;
    Diagnostics errors;
    auto checked = run->number("<values>", text, errors);
    if (!checked) {
        note(errors, run->script().sources);
        return nullptr;
    }
    return &formulas.emplace(key, std::move(*checked)).first->second;
}

const Field* Pattern::Implementation::plane_of(const Formula& formula) const {
    const Simulation& simulation = run->simulation();
    const SimulationDomain& domain = simulation.domain();
    if (formula.nodes.size() != 1 || domain.mask || domain.model) return nullptr;
    const Node& node = formula.nodes.back();
    std::uint32_t of = stage();
    const ItemId* item = node.as<ItemId>();
    if (const auto* const other = node.as<StageItem>()) {
        of = other->stage;
        item = &other->item;
    }
    if (item == nullptr || simulation.state(of).tissue()) return nullptr;
    const bool is_quantity = *item < domain.program->system_of(of).quantities.next();
    if (!is_quantity || !simulation.state(of).started) return nullptr;
    const Field& field = simulation.field(of, *item);
    return field.empty() ? nullptr : &field;  // A uniform item has no plane.
}

Field Pattern::Implementation::computed(const Formula& formula) const {
    const Simulation& simulation = run->simulation();
    Field field = std::move(simulation.evaluate(formula, stage())[0]);
    if (const Tissue* cells = simulation.state(stage()).tissue()) {
        return row_in_order(field, *cells);
    }
    if (const auto of = model()) return in_one_row(field, *of);
    return field;
}

PatternView Pattern::view(const std::string& text) {
    if (!self_->running() || !self_->check()) return {};
    self_->forget_error();
    const Formula* const formula = self_->formula(text);
    if (formula == nullptr) return {};
    PatternView view;
    if (const Field* const plane = self_->plane_of(*formula)) {
        view = view_of(*plane, share(*plane));
    } else {
        const auto field = std::make_shared<const Field>(self_->computed(*formula));
        view = view_of(*field, field);
        view.is_computed = true;
    }
    view.moment = self_->moment;
    return view;
}

std::vector<float> Pattern::values(const std::string& text) { return copied<float>(view(text)); }
std::vector<double> Pattern::numbers(const std::string& text) { return copied<double>(view(text)); }

std::vector<PatternParameter> Pattern::parameters() const {
    std::vector<PatternParameter> parameters;
    const Program* const program = self_->known_program();
    for (std::uint32_t k = 0; program && k < program->stages.size(); ++k) {
        const Stage& stage = program->stages[k];
        const System& system = program->system_of(k);
        for (const ItemId item : system.quantities.ids()) {
            const Quantity& quantity = system.quantities[item];
            if (quantity.is_species) continue;
            PatternParameter parameter{
                stage.name, quantity.name,       quantity.doc,
                {},         stage.uniform[item], std::numeric_limits<double>::quiet_NaN()};
            if (const auto& range = quantity.range) {
                parameter.range = {range->low, range->high, range->step};
            }
            if (parameter.is_uniform && self_->run && self_->run->simulation().state(k).started) {
                parameter.value = self_->run->simulation().state(k).numbers[item];
            }
            parameters.push_back(std::move(parameter));
        }
    }
    return parameters;
}

std::vector<std::string> Pattern::remarks() const {
    std::vector<std::string> remarks;
    if (!self_->run) return remarks;
    const Simulation& simulation = self_->run->simulation();
    for (std::uint32_t k = 0; k <= self_->stage(); ++k) {
        remarks.push_back(outlook(*simulation.domain(k).program, k));
        if (simulation.state(k).done) remarks.push_back(remark_on(simulation, k));
    }
    std::erase(remarks, "");
    return remarks;
}

std::vector<PatternFeature> Pattern::features(const std::string& expression) {
    if (!self_->running() || !self_->check()) return {};
    self_->forget_error();
    auto painter = make_painter(*self_->run, picture_of(expression));
    if (!painter) {
        self_->note(painter.error());
        return {};
    }
    const auto values = measure::to_array(measure_shown(*painter, self_->run->simulation()));
    std::vector<PatternFeature> features;
    for (std::size_t k = 0; k < values.size(); ++k) {
        features.push_back({std::string(measure::feature_names()[k]), values[k]});
    }
    return features;
}

std::string Pattern::analysis(const std::string& stage, bool as_json) {
    if (!self_->run) return "";
    self_->forget_error();
    const Script& now = self_->run->script();
    Script script = load_script(now.name, now.text, now.folder, now.overrides);
    AnalyzeRequest request;
    request.stage = stage;
    request.as_json = as_json;
    const auto report = analyze(script, request);
    if (report) return report->text;
    if (script.diagnostics.has_errors()) self_->note(script.diagnostics, script.sources);
    else self_->note(report.error());
    return "";
}

std::string Pattern::picture(const std::string& expression) {
    if (!self_->running() || !self_->check()) return "";
    self_->forget_error();
    auto file = session_picture(*self_->run, picture_of(expression));
    if (!file) self_->note(file.error());
    return file ? std::move(*file) : "";
}

bool Pattern::write_picture(const std::string& path, const std::string& expression) {
    if (!self_->running()) return false;
    if (!path.ends_with(".png")) {
        self_->note({"a picture is written to a file that ends in .png, not to " + path,
                     "'cascade run' writes the other formats"});
        return false;
    }
    const std::string file = picture(expression);
    if (file.empty()) return false;
    const auto written = write_file(path, file);
    if (!written) self_->note(written.error());
    return written.has_value();
}

}  // namespace cascade
