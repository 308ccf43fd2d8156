// Finds the position of each slot of a pass in the buffers.
#include "device/problem_text.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "device/kernel_text.h"
#include "device/wgsl_prelude.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {
namespace {

template <typename Plane>
void add_once(std::vector<const Plane*>& planes, const Plane* plane) {
    if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
}

template <typename Plane>
std::int64_t place_of(const std::vector<const Plane*>& planes, const Plane* plane) {
    return std::find(planes.begin(), planes.end(), plane) - planes.begin();
}

class ProblemPrinter {
public:
    ProblemPrinter(const StepProblem& problem, const TextTarget& target, std::int64_t rows_of_item)
        : problem_(problem),
          target_(target),
          rows_of_item_(rows_of_item),
          layout_(problem.grid),
          planes_(problem) {}

    std::string print() const {
        const Stencil stencil = problem_.grid.stencil();
        std::string text =
            is_wgsl()
                ? wgsl_prelude(target_, wgsl_call_words(problem_)) + wgsl_stencil(stencil, layout_)
                : prelude_text(target_) + stencil_text(target_, stencil, layout_);
        for (std::size_t pass = 0; pass < problem_.passes.size(); ++pass) {
            const StepProblem::Pass& bound = problem_.passes[pass];
            CHECK(bound.source, "a device prints kernels of known source");
            text += is_wgsl() ? wgsl_names_of(pass) : parameters_of(pass);
            text += cells_begin(target_, stencil, layout_, rows_of_item_);
            text += cell_text(*bound.source, names_of(pass), target_, stencil, layout_);
            text += std::string(cells_end) + "}\n";
        }
        return text;
    }

private:
    bool is_wgsl() const { return target_.language == TextLanguage::wgsl; }

    /// The head of a kernel in WGSL, and names for the words of a call.
    std::string wgsl_names_of(std::size_t pass) const {
        std::string text = wgsl_head(kernel_name(pass)) + "{\n";
        std::size_t word = first_call_word;
        const auto plane_at = [&](std::string_view name) {
            text += fmt::format("    let {} = bitcast<i32>({});\n", name, wgsl_call_word(word++));
        };
        for (std::uint32_t k = 0; k < problem_.registers; ++k) {
            plane_at(fmt::format("c_register_{}", k));
        }
        plane_at("c_temporaries");
        plane_at("c_fields");
        const std::size_t passed = passed_uniforms(problem_.passes[pass]).size();
        for (std::size_t k = 0; k < passed; ++k) {
            text += fmt::format("    let c_passed_{} = {};\n", k, wgsl_call_word(word++));
        }
        return text;
    }

    std::string parameters_of(std::size_t pass) const {
        std::string text = fmt::format("__kernel void {}(", kernel_name(pass));
        for (std::uint32_t k = 0; k < problem_.registers; ++k) {
            text += fmt::format("__global cw* c_register_{}, ", k);
        }
        text +=
            "__global cw* c_temporaries, __global const cw* c_fields, "
            "__global const uchar* c_masks, __global const cw* c_uniforms, "
            "__global const cw* c_aggregates";
        text += link_parameters(target_, problem_.grid.linked);
        text += ", const cw c_pad, const int c_first_row, const int c_last_row";
        const std::size_t passed = passed_uniforms(problem_.passes[pass]).size();
        for (std::size_t k = 0; k < passed; ++k) text += fmt::format(", const cw c_passed_{}", k);
        return text + ") {\n";
    }

    std::string element(std::string_view buffer, std::int64_t index) const {
        return fmt::format("{} + {}{}", buffer, index, is_wgsl() ? "" : "l");
    }
    /// Cell (0, 0, 0) of plane number `plane` of a buffer.
    std::string plane(std::string_view buffer, std::int64_t plane) const {
        return element(buffer, plane * layout_.size() + layout_.offset(0, 0));
    }

    std::string plane(const StepProblem::PlaneRef& ref) const {
        return std::visit(
            Overloaded{
                [&](const StepProblem::SpeciesPlane& own) {
                    return plane(fmt::format("c_register_{}", own.in_register.index()),
                                 own.species.index());
                },
                [&](TemporaryId id) { return plane("c_temporaries", id.index()); },
                [&](const Field* field) {
                    return element("c_fields", planes_.origin(planes_.number_of(field)));
                },
            },
            ref);
    }

    KernelNames names_of(std::size_t number) const {
        const StepProblem::Pass& pass = problem_.passes[number];
        KernelNames names;
        for (const auto& field : pass.fields) names.fields.push_back(plane(field));
        for (const Mask* mask : pass.masks) {
            names.masks.push_back(
                plane(is_wgsl() ? "0" : "c_masks", place_of(planes_.masks, mask)));
        }
        for (const auto& result : pass.results) names.results.push_back(plane(result.plane));
        const std::size_t first = first_uniform(problem_, number);
        for (std::size_t k = 0; k < pass.uniforms.size(); ++k) {
            names.uniforms.push_back(fmt::format("c_uniforms[{}]", first + k));
        }
        for (const auto& changing : pass.changing) {
            if (const auto* const id = std::get_if<AggregateId>(&changing.value)) {
                names.uniforms[changing.slot.index()] =
                    fmt::format("c_aggregates[{}]", id->index());
            }
        }
        const auto passed = passed_uniforms(pass);
        for (std::size_t k = 0; k < passed.size(); ++k) {
            names.uniforms[passed[k].slot.index()] = fmt::format("c_passed_{}", k);
        }
        return names;
    }

    const StepProblem& problem_;
    const TextTarget& target_;
    std::int64_t rows_of_item_;
    PlaneLayout layout_;
    ConstantPlanes planes_;
};

}  // namespace

ConstantPlanes::ConstantPlanes(const StepProblem& problem) {
    const auto add = [this](const StepProblem::PlaneRef& ref) {
        if (const auto* const field = std::get_if<const Field*>(&ref)) add_once(fields, *field);
    };
    for (const StepProblem::Pass& pass : problem.passes) {
        for (const auto& field : pass.fields) add(field);
        for (const auto& reduction : pass.reductions) add(reduction.operand);
        for (const Mask* mask : pass.masks) add_once(masks, mask);
    }
    for (const Field* field : fields) {
        places.push_back(size);
        size += field->layout().size();
    }
}

std::size_t ConstantPlanes::number_of(const Field* field) const {
    return static_cast<std::size_t>(std::find(fields.begin(), fields.end(), field) -
                                    fields.begin());
}

std::vector<StepProblem::ChangingUniform> passed_uniforms(const StepProblem::Pass& pass) {
    std::vector<StepProblem::ChangingUniform> passed;
    for (const auto& uniform : pass.changing) {
        if (!std::holds_alternative<AggregateId>(uniform.value)) passed.push_back(uniform);
    }
    return passed;
}

std::string kernel_name(std::size_t pass) { return fmt::format("c_pass_{}", pass); }

std::size_t wgsl_call_words(const StepProblem& problem) {
    std::size_t passed = 0;
    for (const StepProblem::Pass& pass : problem.passes) {
        passed = std::max(passed, passed_uniforms(pass).size());
    }
    return first_call_word + problem.registers + 2 + passed;
}

std::size_t first_uniform(const StepProblem& problem, std::size_t pass) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < pass; ++k) count += problem.passes[k].uniforms.size();
    return count;
}

std::string reason_against_text(const StepProblem& problem) {
    for (const StepProblem::Pass& pass : problem.passes) {
        if (!pass.solves.empty()) return "it has a constraint 0 = …";
        if (!pass.convolutions.empty()) return "it has a convolution";
        if (pass.filter) return "its solver filters waves";
        if (!pass.source) return "its kernels have no text";
    }
    for (const ChangingSide& side : problem.changing_sides) {
        const auto& reads = side.reads;
        if (std::any_of(reads.begin(), reads.end(),
                        [](const auto& each) { return each.has_value(); })) {
            return "the values at its sides depend on species";
        }
    }
    return "";
}

std::string problem_text(const StepProblem& problem, const TextTarget& target,
                         std::int64_t rows_of_item) {
    return ProblemPrinter(problem, target, rows_of_item).print();
}

}  // namespace cascade
