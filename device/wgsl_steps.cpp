// Lays out the planes of a problem in one buffer: copies of the species, scratch registers,
// temporaries, constant fields.
#include "device/wgsl_steps.h"

#include "core/check.h"
#include "device/pass_values.h"
#include "device/problem_text.h"
#include "device/wgsl_kernels.h"
#include "device/wgsl_links.h"
#include "device/wgsl_prelude.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace cascade {
namespace {

std::uint32_t group_count(std::int64_t items, std::int64_t group) {
    return static_cast<std::uint32_t>((items + group - 1) / group);
}

std::uint32_t word_of_place(std::size_t place) { return static_cast<std::uint32_t>(place); }

void append_numbers(std::vector<std::uint32_t>& words, const std::vector<double>& numbers) {
    for (const double number : numbers) {
        words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(number)));
    }
}

}  // namespace

WgslCall call_of_plane(const PlaneLayout& layout) {
    WgslCall call;
    call.words = {0, 0, static_cast<std::uint32_t>(layout.row_count()), 0};
    call.groups_x = group_count(layout.width, wgsl_group_width);
    call.groups_y = group_count(layout.row_count(), wgsl_group_height);
    return call;
}

std::string reason_against_wgsl(const StepProblem& problem) {
    if (problem.precision == Precision::binary64) return "WebGPU has no double precision";
    if (problem.aggregates > 0 || problem.error_register.has_value()) {
        return "sums over all cells are taken in double precision, which WebGPU lacks";
    }
    return reason_against_text(problem);
}

WgslSteps::WgslSteps(const StepProblem& problem, Flushing flushing, std::size_t species,
                     std::size_t copies)
    : problem_(problem), layout_(problem.grid), species_(species), copies_(copies) {
    CHECK(reason_against_wgsl(problem).empty(), "WebGPU can take the steps");
    TextTarget target;
    target.flushing = flushing;
    target.language = TextLanguage::wgsl;
    program_ = problem_text(problem, target, 1);
    halo_program_ = wgsl_halo(flushing, layout_);
}

std::size_t WgslSteps::temporaries() const {
    return place_of(RegisterId(problem_.registers), CopyRoles{});
}

std::size_t WgslSteps::constants() const {
    return temporaries() + problem_.temporaries * static_cast<std::size_t>(layout_.size());
}

std::size_t WgslSteps::plane_words() const {
    return constants() + static_cast<std::size_t>(ConstantPlanes(problem_).size);
}

std::size_t WgslSteps::place_of(int copy, std::size_t species) const {
    return (static_cast<std::size_t>(copy) * species_ + species) *
           static_cast<std::size_t>(layout_.size());
}

std::size_t WgslSteps::place_of(RegisterId id, CopyRoles roles) const {
    if (id == old_register) return place_of(roles.current, 0);
    if (id == new_register) return place_of(roles.target(), 0);
    const std::size_t scratch = id.index() - first_scratch_register.index();
    return (copies_ + scratch) * species_ * static_cast<std::size_t>(layout_.size());
}

std::vector<WgslSteps::ConstantPlane> WgslSteps::constant_planes() const {
    std::vector<ConstantPlane> planes;
    const ConstantPlanes all(problem_);
    for (std::size_t k = 0; k < all.fields.size(); ++k) {
        const PlaneLayout& layout = all.fields[k]->layout();
        const float* const memory = all.fields[k]->origin<float>() - layout.offset(0, 0);
        planes.push_back({constants() + static_cast<std::size_t>(all.places[k]),
                          packed_words(memory, static_cast<std::size_t>(layout.size()))});
    }
    return planes;
}

std::vector<std::uint32_t> WgslSteps::mask_words() const {
    std::vector<std::uint8_t> bytes;
    for (const Mask* const mask : ConstantPlanes(problem_).masks) {
        const std::uint8_t* const memory = mask->origin() - layout_.offset(0, 0);
        bytes.insert(bytes.end(), memory, memory + layout_.size());
    }
    return packed_words(bytes.data(), bytes.size());
}

std::vector<std::uint32_t> WgslSteps::uniforms() const {
    std::vector<std::uint32_t> words;
    for (const StepProblem::Pass& pass : problem_.passes) append_numbers(words, pass.uniforms);
    return words;
}

std::vector<std::uint32_t> WgslSteps::links() const {
    if (problem_.links == nullptr) return {};
    return WgslLinks(problem_.links->table<float>(), layout_).words;
}

void WgslSteps::add(std::size_t pass, CopyRoles roles, const StepMoment& moment,
                    std::vector<WgslCall>& calls, std::vector<std::uint32_t>& sides) const {
    const StepProblem::Pass& bound = problem_.passes[pass];
    WgslCall call = call_of_plane(layout_);
    call.kernel = kernel_name(pass);
    if (problem_.links != nullptr) {
        const WgslLinks links(problem_.links->table<float>(), layout_);
        call.words.insert(call.words.end(), links.places.begin(), links.places.end());
    }
    call.words.resize(first_call_word);
    for (std::uint32_t k = 0; k < problem_.registers; ++k) {
        call.words.push_back(word_of_place(place_of(RegisterId(k), roles)));
    }
    call.words.push_back(word_of_place(temporaries()));
    call.words.push_back(word_of_place(constants()));
    for (const auto& uniform : passed_uniforms(bound)) {
        call.words.push_back(std::bit_cast<std::uint32_t>(passed_value<float>(uniform, moment)));
    }
    call.words.resize(wgsl_call_words(problem_));
    calls.push_back(std::move(call));

    if (!problem_.has_halo()) return;
    std::vector<std::size_t> origins;
    std::vector<SideRules> rules;
    for (const StepProblem::Result& result : bound.results) {
        if (!result.needs_halo) continue;
        const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&result.plane);
        const std::size_t first =
            own != nullptr ? place_of(own->in_register, roles) : temporaries();
        const std::size_t number =
            own != nullptr ? own->species.index() : std::get<TemporaryId>(result.plane).index();
        origins.push_back(first + number * static_cast<std::size_t>(layout_.size()) +
                          static_cast<std::size_t>(layout_.offset(0, 0)));
        rules.push_back(problem_.changing_sides.empty() ? problem_.sides_of(result)
                                                        : halo_rules_at(problem_, result, moment));
    }
    if (!origins.empty()) add_halo(origins, rules, calls, sides);
}

void WgslSteps::add_halo(const std::vector<std::size_t>& origins,
                         const std::vector<SideRules>& rules, std::vector<WgslCall>& calls,
                         std::vector<std::uint32_t>& sides) const {
    const HaloRecords records(rules);
    WgslCall call;
    call.is_halo = true;
    call.kernel = "c_halo";
    call.words.resize(first_call_word);
    call.words.push_back(word_of_place(sides.size()));
    call.words.push_back(word_of_place(origins.size()));
    for (const std::size_t origin : origins) sides.push_back(word_of_place(origin));
    for (const std::int32_t kind : records.kinds) {
        sides.push_back(static_cast<std::uint32_t>(kind));
    }
    append_numbers(sides, records.numbers);
    append_numbers(sides, records.values);
    const auto planes = static_cast<std::int64_t>(origins.size());
    const auto add_call = [&](std::int64_t cells, std::int64_t slices, std::uint32_t is_slice) {
        WgslCall added = call;
        added.words.push_back(is_slice);
        added.groups_x = group_count(cells, wgsl_halo_group);
        added.groups_y = static_cast<std::uint32_t>(planes * slices);
        calls.push_back(std::move(added));
    };
    add_call(2 * (layout_.width + 2) + 2 * layout_.height, layout_.depth, 0);
    if (layout_.has_halo_slices()) add_call((layout_.width + 2) * (layout_.height + 2), 2, 1);
}

}  // namespace cascade
