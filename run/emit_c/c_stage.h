// Describes a stage for a C program: tables of planes and numbers, kernels, and the bodies of the
// functions that run its passes. The plans and their order are the same as in `cascade run`.
#pragma once

#include "core/result.h"
#include "core/side.h"
#include "ir/cell_kernel.h"
#include "lang/program/program.h"
#include "run/domain/input_files.h"
#include "solvers/scheme.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Contains, by stage and item, the values of uniform items that can be computed without any field.
using KnownNumbers = std::vector<IdVector<ItemId, std::optional<float>>>;

/// A row of a table in the header. `identifier` is the name in C of the row's index, as in
/// NAME_PLANE_BETA.
struct CEntry {
    std::string identifier;
    std::string meaning;  ///< A description for the comment in the header.
    /// Whether the program that includes the header must set the value, because the functions of
    /// the header do not compute it.
    bool is_given = false;
};

struct CNumber : CEntry {
    float value = 0;
};

struct CPlane : CEntry {
    /// The name of the array in the object file that has the values of the plane. Empty if there is
    /// no such array.
    std::string data;
};

/// A constant array in the object file, with one number for each cell.
struct CData {
    std::string name;
    std::vector<float> values;
};

/// A kernel, and the name of its function in C.
struct CKernel {
    std::string name;
    CellKernel kernel;
};

struct CStage {
    std::string name;  ///< The name of the struct, and the prefix of all other names.
    std::vector<CEntry> species;
    std::vector<CNumber> numbers;  ///< Uniform values.
    std::vector<CPlane> planes;    ///< Values that are the same in all steps but vary by cell.
    std::vector<CEntry> masks;
    std::vector<CData> data;
    std::vector<CKernel> kernels;
    /// For each species, the kinds of its sides. Empty if all species have the boundary of the
    /// domain.
    std::vector<std::array<SideKind, side_count>> sides;
    std::uint32_t side_planes = 0;  ///< The number of planes for values that vary along sides.
    std::uint32_t scratch_registers = 0;
    std::uint32_t temporaries = 0;
    std::uint32_t step_aggregates = 0;
    bool reduces = false;  ///< Whether the stage reads sums, means or extremes over the domain.
    std::optional<std::size_t> speed;  ///< The index of `speed` in `numbers`, if it is uniform.
    /// The index of `frozen` in `numbers`, if it is uniform and not known to be 0.
    std::optional<std::size_t> frozen;
    std::string start;  ///< Statements that compute the starting values.
    /// Statements of a step, except the exchange of old and new registers at its end.
    std::string step;
};

/// The input of describe_c_stage().
struct CStageRequest {
    /// The program, in which the parameters of CompileRequest::per_cell vary by cell.
    const Program& program;
    std::uint32_t stage = 0;
    /// The known numbers of all stages up to and including this stage.
    const KnownNumbers& numbers;
    const InputFiles& files;
    const std::vector<Field>& metric;
    const Scheme& scheme;
    std::string name;
};

/// Describes a stage. Fails if the stage reads, at neighbours, a species of another stage that has
/// sides of its own.
Result<CStage> describe_c_stage(const CStageRequest& request);

}  // namespace cascade
