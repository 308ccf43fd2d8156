// A row is added to a table when its operand is read for the first time. Identifiers are upper-case
// names. If a name is taken, a number is added to it.
#include "run/emit_c/c_tables.h"

#include "core/check.h"
#include "core/counted_cells.h"
#include "core/overloaded.h"
#include "lang/lower/lower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade {

namespace {

/// Returns a name as part of an upper-case C identifier. u[2] becomes U_2.
std::string capitals(std::string_view name) {
    std::string text;
    for (const char c : name) {
        if (c == ']') continue;
        const auto letter = static_cast<unsigned char>(c);
        text += std::isalnum(letter) ? static_cast<char>(std::toupper(letter)) : '_';
    }
    return text;
}

/// Adds an entry to a table, with an identifier that no other entry has.
template <typename Entry>
void add_entry(std::vector<Entry>& table, Entry entry, std::string_view name) {
    const std::string wanted = capitals(name);
    entry.identifier = wanted;
    const auto is_taken = [&] {
        return std::any_of(table.begin(), table.end(), [&](const Entry& other) {
            return other.identifier == entry.identifier;
        });
    };
    for (int number = 2; is_taken(); ++number)
        entry.identifier = fmt::format("{}_{}", wanted, number);
    table.push_back(std::move(entry));
}

/// Returns the index of a source in `known`. If the source is new, appends it and calls `add`.
template <typename Source, typename Add>
std::size_t place_of(std::vector<Source>& known, const Source& source, const Add& add) {
    const auto place = std::find(known.begin(), known.end(), source) - known.begin();
    if (static_cast<std::size_t>(place) == known.size()) {
        known.push_back(source);
        add();
    }
    return static_cast<std::size_t>(place);
}

}  // namespace

CTables::CTables(const CStageRequest& request, CStage& stage)
    : request_(request),
      program_(request.program),
      system_(program_.system_of(request.stage)),
      stage_(stage) {
    const Stage& source = program_.stages[request.stage];
    const StepPlan early = plan_uniform_start(program_, request.stage);
    for (const ItemId item : system_.items()) {
        if (system_.is_species(item)) {
            add_entry(stage_.species, {std::string(), item_path({request.stage, item}), false},
                      system_.item_name(item));
        }
        const bool is_early =
            std::find(early.results.begin(), early.results.end(), item) != early.results.end();
        if (source.uniform[item] && !is_early) late_.push_back(item);
    }
    for (const auto& settings : source.sides) {
        auto& kinds = stage_.sides.emplace_back();
        for (std::size_t side = 0; side < side_count; ++side) kinds[side] = settings[side].kind;
    }
}

std::string CTables::item_path(StageItem item) const {
    return fmt::format("{} of stage '{}'", program_.system_of(item.stage).item_name(item.item),
                       program_.stages[item.stage].name);
}

std::string CTables::item_name(StageItem item) const {
    const std::string_view name = program_.system_of(item.stage).item_name(item.item);
    if (item.stage == request_.stage) return std::string(name);
    return fmt::format("{}_{}", program_.stages[item.stage].name, name);
}

bool CTables::is_late(ItemId item) const {
    return std::find(late_.begin(), late_.end(), item) != late_.end();
}

std::size_t CTables::number_place(StageItem item) {
    return place_of(numbers_, item, [&] {
        const auto value = request_.numbers[item.stage][item.item];
        CNumber entry;
        entry.meaning = item_path(item);
        entry.value = value.value_or(0.0F);
        entry.is_given = !value && (item.stage != request_.stage || !is_late(item.item));
        add_entry(stage_.numbers, entry, item_name(item));
    });
}

std::string CTables::number(StageItem item) {
    return fmt::format("s->numbers[{}]", number_place(item));
}

void CTables::add_plane(const PlaneSource& source) {
    CPlane plane;
    std::string name;
    const Overloaded describe{
        [&](NamedPlane each) {
            plane.meaning = fmt::format("\"{}\"", program_.literals->text(each.text));
            name = fmt::format("file{}", planes_.size());
            plane.data = add_data(request_.files.plane(each));
        },
        [&](MetricPlane each) {
            const auto number = static_cast<std::size_t>(each);
            plane.meaning = "how the cells lie on the surface";
            name = fmt::format("metric{}", number);
            plane.data = add_data(request_.metric[number]);
        },
        [&](StageItem item) {
            plane.meaning = item_path(item);
            plane.is_given = item.stage != request_.stage;
            name = item_name(item);
        },
        [](auto) { CHECK(false, "stages of models and masks are not compiled"); },
    };
    std::visit(describe, source);
    add_entry(stage_.planes, plane, name);
}

std::string CTables::plane(const PlaneSource& source) {
    if (const auto* const id = std::get_if<TemporaryId>(&source)) return temporary(id->index());
    const auto* const item = std::get_if<StageItem>(&source);
    if (item != nullptr && item->stage == request_.stage) {
        const auto species = system_.species_of(item->item);
        if (species) return fmt::format("s->species[{}]", species->index());
    }
    return fmt::format("s->planes[{}]", place_of(planes_, source, [&] { add_plane(source); }));
}

std::string CTables::mask(StageItem item) {
    const std::size_t place = place_of(masks_, item, [&] {
        add_entry(stage_.masks, {std::string(), item_path(item), item.stage != request_.stage},
                  item_name(item));
    });
    return fmt::format("s->masks[{}]", place);
}

std::string CTables::temporary(std::size_t number) {
    stage_.temporaries = std::max(stage_.temporaries, static_cast<std::uint32_t>(number) + 1);
    return fmt::format("s->temporaries[{}]", number);
}

std::string CTables::kernel(const CellKernel& kernel) {
    for (const CKernel& known : stage_.kernels) {
        if (known.kernel.code == kernel.code && known.kernel.results == kernel.results) {
            return known.name;
        }
    }
    const std::string name = fmt::format("{}_kernel{}", request_.name, stage_.kernels.size() + 1);
    stage_.kernels.push_back({name, kernel});
    return name;
}

std::string CTables::add_data(const Field& field) {
    CData data{fmt::format("{}_data{}", request_.name, stage_.data.size() + 1), {}};
    for_each_cell([&](float value) { data.values.push_back(value); }, field.plane());
    stage_.data.push_back(std::move(data));
    return stage_.data.back().name;
}

}  // namespace cascade
