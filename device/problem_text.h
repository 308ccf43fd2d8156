// Prints the passes of a step as one program.
#pragma once

#include "device/prelude.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// The planes of a problem that no pass writes, in the order in which they are stored in a device's
/// memory.
struct ConstantPlanes {
    std::vector<const Field*> fields;
    std::vector<const Mask*> masks;
    /// For each field, the number of elements stored before it. Fields differ in size, because some
    /// have one number for each link.
    std::vector<std::int64_t> places;
    std::int64_t size = 0;  ///< The number of elements of all fields.

    explicit ConstantPlanes(const StepProblem& problem);

    /// The number of a field in `fields`.
    std::size_t number_of(const Field* field) const;
    /// The index of cell (0, 0, 0), or of link 0, of field number `number`.
    std::int64_t origin(std::size_t number) const {
        return places[number] + fields[number]->layout().offset(0, 0);
    }
};

/// The uniforms that are passed at each call: all uniforms that change, except aggregates.
std::vector<StepProblem::ChangingUniform> passed_uniforms(const StepProblem::Pass& pass);

/// The name of a pass's kernel. Its parameters are, in this order:
///   - a buffer for each register, with one plane for each species
///   - temporaries, constant fields, masks, the uniforms of all passes, aggregates
///   - the links, if cells are linked (link_parameters())
///   - c_pad = 0, the first row, the row after the last one
///   - a word for each of passed_uniforms()
/// In WGSL, buffers and the first words of a call are as in wgsl_prelude.h. The words that follow
/// are, from first_call_word on:
///   - the places in c_planes at which the planes begin: each register, temporaries, constant
///   fields
///   - a word for each of passed_uniforms()
std::string kernel_name(std::size_t pass);

/// The reason why the passes of a problem cannot be printed, as the end of a sentence. Empty if
/// they can be printed.
std::string reason_against_text(const StepProblem& problem);

/// The whole program. A work-item computes `rows_of_item` rows of a column or, in WGSL, one cell. A
/// program in WGSL cannot read aggregates.
std::string problem_text(const StepProblem& problem, const TextTarget& target,
                         std::int64_t rows_of_item);

/// The number of words that a call passes in WGSL.
std::size_t wgsl_call_words(const StepProblem& problem);

/// The number of uniforms of all passes before this one.
std::size_t first_uniform(const StepProblem& problem, std::size_t pass);

}  // namespace cascade
