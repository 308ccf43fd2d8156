// Binds the arguments of the kernels that problem_text.h prints.
#include "device/device_passes.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "device/link_arrays.h"
#include "device/pass_values.h"

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

std::int64_t padded_width(const PlaneLayout& layout) {
    return (layout.width + PlaneLayout::row_pad - 1) / PlaneLayout::row_pad * PlaneLayout::row_pad;
}

}  // namespace

std::int64_t rows_of_item(const DeviceFacts& facts, const StepProblem& problem) {
    // On a processor, the driver runs work-groups one after the other, so larger groups cost less.
    const std::int64_t rows = problem.grid.height * problem.grid.depth;
    return facts.is_gpu ? 1 : std::clamp<std::int64_t>(rows / 64, 1, 8);
}

DevicePasses::DevicePasses(Device& device, const StepProblem& problem, const TextTarget& target,
                           DeviceHalos& halos, DeviceSums* sums)
    : device_(device),
      problem_(problem),
      target_(target),
      layout_(problem.grid),
      constants_(problem),
      halos_(halos),
      sums_(sums),
      rows_of_item_(rows_of_item(device.facts(), problem)),
      rows_of_launch_(layout_.row_count()),
      group_(device.open().group_for(static_cast<std::size_t>(padded_width(layout_)),
                                     PlaneLayout::row_pad)) {
    text_ = problem_text(problem, target, rows_of_item_);
    const DeviceProgram& program = device_.program(text_, target);
    for (std::size_t pass = 0; pass < problem_.passes.size(); ++pass) {
        passes_.push_back(
            {program.kernel(kernel_name(pass)), passed_uniforms(problem_.passes[pass]), {}});
        add_halos(pass);
    }
    write_constants();
    if (problem_.links != nullptr) write_links();
}

bool DevicePasses::are_of(const StepProblem& problem, const std::string& text) const {
    return &problem == &problem_ && text == text_ &&
           ConstantPlanes(problem).fields == constants_.fields;
}

std::uint64_t DevicePasses::constant_bytes(const StepProblem& problem) {
    const ConstantPlanes constants(problem);
    const PlaneLayout layout(problem.grid);
    return static_cast<std::uint64_t>(constants.size) * bytes_of(problem.precision) +
           constants.masks.size() * Mask::bytes(layout) +
           (problem.links != nullptr ? problem.links->bytes() : 0);
}

std::int64_t DevicePasses::origin(std::size_t plane) const {
    return static_cast<std::int64_t>(plane) * layout_.size() + layout_.offset(0, 0);
}

void DevicePasses::write_constants() {
    OpenDevice& device = device_.open();
    const std::size_t bytes = bytes_of(problem_.precision);
    fields_ = device.buffer(static_cast<std::size_t>(constants_.size) * bytes);
    for (std::size_t k = 0; k < constants_.fields.size(); ++k) {
        const Field& field = *constants_.fields[k];
        device.write(fields_, static_cast<std::size_t>(constants_.places[k]) * bytes,
                     memory_of(field), Field::bytes(field.layout(), problem_.precision));
    }
    masks_ = device.buffer(constants_.masks.size() * Mask::bytes(layout_));
    for (std::size_t k = 0; k < constants_.masks.size(); ++k) {
        device.write(masks_, k * Mask::bytes(layout_),
                     constants_.masks[k]->origin() - layout_.offset(0, 0), Mask::bytes(layout_));
    }
    std::vector<double> uniforms;
    for (const StepProblem::Pass& pass : problem_.passes) {
        uniforms.insert(uniforms.end(), pass.uniforms.begin(), pass.uniforms.end());
    }
    write_words(device, uniforms_, uniforms, problem_.precision);
    write_words(device, aggregates_, std::vector<double>(problem_.aggregates), problem_.precision);
}

void DevicePasses::write_links() {
    with_number(problem_.precision, [&](auto zero) { write_links_as<decltype(zero)>(); });
}

template <typename Number>
void DevicePasses::write_links_as() {
    const LinkTable<Number> table = problem_.links->table<Number>();
    const auto add = [&](const auto* values, std::size_t count) {
        const std::size_t bytes = values != nullptr ? count * sizeof *values : 0;
        links_.push_back(device_.open().buffer(bytes));
        device_.open().write(links_.back(), 0, values, bytes);
    };
    for_link_arrays(table, layout_, add);
}

void DevicePasses::add_halos(std::size_t pass) {
    if (!problem_.has_halo()) return;
    std::vector<OfPass::Halos>& all = passes_[pass].halos;
    const std::vector<StepProblem::Result>& results = problem_.passes[pass].results;
    std::vector<std::vector<std::int64_t>> origins;
    std::vector<std::vector<SideRules>> rules;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (!results[k].needs_halo) continue;
        const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&results[k].plane);
        const auto in_register =
            own != nullptr ? std::optional<RegisterId>(own->in_register) : std::nullopt;
        const auto found = std::find_if(all.begin(), all.end(), [&](const OfPass::Halos& each) {
            return each.in_register == in_register;
        });
        const auto number = static_cast<std::size_t>(found - all.begin());
        if (found == all.end()) {
            all.push_back({in_register, {}, {}});
            origins.emplace_back();
            rules.emplace_back();
        }
        const std::size_t plane =
            own != nullptr ? own->species.index() : std::get<TemporaryId>(results[k].plane).index();
        all[number].results.push_back(k);
        origins[number].push_back(origin(plane));
        rules[number].push_back(problem_.sides_of(results[k]));
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].group = halos_.group(std::move(origins[k]), rules[k]);
    }
}

void DevicePasses::run(std::size_t pass, CopyRoles roles, const StepMoment& moment,
                       const DevicePlanes& planes) {
    moment.leave_if_cancelled();
    reduce(pass, roles, planes);
    with_number(problem_.precision,
                [&](auto zero) { launch<decltype(zero)>(passes_[pass], roles, moment, planes); });
    fill_halos(pass, roles, moment, planes);
}

template <typename Number>
void DevicePasses::launch(OfPass& pass, CopyRoles roles, const StepMoment& moment,
                          const DevicePlanes& planes) {
    const std::int64_t rows = layout_.row_count();
    for (std::int64_t first = 0; first < rows; first += rows_of_launch_) {
        const std::int64_t last = std::min(rows, first + rows_of_launch_);
        DeviceKernel& kernel = pass.kernel;
        kernel.begin();
        for (std::uint32_t k = 0; k < problem_.registers; ++k) {
            kernel.add(planes.of(RegisterId(k), roles));
        }
        kernel.add(planes.temporaries());
        kernel.add(fields_);
        kernel.add(masks_);
        kernel.add(uniforms_);
        kernel.add(aggregates_);
        for (const DeviceBuffer& table : links_) kernel.add(table);
        kernel.add(WordOf<Number>{0});
        kernel.add(static_cast<std::int32_t>(first));
        kernel.add(static_cast<std::int32_t>(last));
        for (const auto& uniform : pass.passed) kernel.add(passed_value<Number>(uniform, moment));
        device_.open().launch(
            kernel, static_cast<std::size_t>(padded_width(layout_)),
            static_cast<std::size_t>((last - first + rows_of_item_ - 1) / rows_of_item_), group_);
    }
}

void DevicePasses::fill_halos(std::size_t pass, CopyRoles roles, const StepMoment& moment,
                              const DevicePlanes& planes) {
    for (OfPass::Halos& each : passes_[pass].halos) {
        if (!problem_.changing_sides.empty()) {
            std::vector<SideRules> rules;
            for (const std::size_t result : each.results) {
                rules.push_back(
                    halo_rules_at(problem_, problem_.passes[pass].results[result], moment));
            }
            halos_.set_rules(each.group, rules);
        }
        halos_.fill(each.in_register ? planes.of(*each.in_register, roles) : planes.temporaries(),
                    each.group);
    }
}

void DevicePasses::reduce(std::size_t pass, CopyRoles roles, const DevicePlanes& planes) {
    for (const StepProblem::Reduction& reduction : problem_.passes[pass].reductions) {
        const DevicePlane plane = std::visit(
            Overloaded{
                [&](const StepProblem::SpeciesPlane& own) {
                    return DevicePlane{planes.of(own.in_register, roles),
                                       origin(own.species.index())};
                },
                [&](TemporaryId id) {
                    return DevicePlane{planes.temporaries(), origin(id.index())};
                },
                [&](const Field* field) {
                    return DevicePlane{fields_, constants_.origin(constants_.number_of(field))};
                },
            },
            reduction.operand);
        CHECK(sums_ != nullptr, "a problem with aggregates has sums");
        sums_->reduce(reduction.kind, plane, problem_.counted_cells(), aggregates_,
                      reduction.aggregate.index());
    }
}

}  // namespace cascade
