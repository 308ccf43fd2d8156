// A compiled stage for a C program: tables of planes and numbers, kernels, and the bodies of the
// functions that run its passes, in the order of a run: the same plans, bound in the same way.
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

/// By stage and item: the values of uniform items that can be computed without any field.
using KnownNumbers = std::vector<IdVector<ItemId, std::optional<float>>>;

/// An entry of a table: `identifier` is its index in C, as in NAME_PLANE_BETA.
struct CEntry {
    std::string identifier;
    std::string meaning;    ///< A description, for the header's comment.
    bool is_given = false;  ///< Not computed: the program must set it before anything reads it.
};

struct CNumber : CEntry {
    float value = 0;
};

struct CPlane : CEntry {
    std::string data;  ///< Array of the object file that fills it; empty for none.
};

/// A constant array in the object file, one number per cell.
struct CData {
    std::string name;
    std::vector<float> values;
};

/// A kernel and the name of its C function.
struct CKernel {
    std::string name;
    CellKernel kernel;
};

struct CStage {
    std::string name;  ///< Of the struct, and the prefix of all other names.
    std::vector<CEntry> species;
    std::vector<CNumber> numbers;  ///< Uniform values.
    std::vector<CPlane> planes;    ///< Step-invariant values that vary by cell.
    std::vector<CEntry> masks;
    std::vector<CData> data;
    std::vector<CKernel> kernels;
    /// By species; empty if the boundary of the domain holds for all.
    std::vector<std::array<SideKind, side_count>> sides;
    std::uint32_t side_planes = 0;  ///< Planes for values that vary along sides.
    std::uint32_t scratch_registers = 0;
    std::uint32_t temporaries = 0;
    std::uint32_t step_aggregates = 0;
    bool reduces = false;               ///< True if there are aggregates over the domain.
    std::optional<std::size_t> speed;   ///< Its number, if it is uniform.
    std::optional<std::size_t> frozen;  ///< Its number, if it is uniform and not known to be 0.
    std::string start;                  ///< Statements that compute the starting values.
    std::string step;                   ///< Statements of a step, up to the exchange of registers.
};

/// The input of describe_c_stage().
struct CStageRequest {
    const Program& program;  ///< With per-cell parameters marked as varying.
    std::uint32_t stage = 0;
    const KnownNumbers& numbers;  ///< Of the stages up to this one.
    const InputFiles& files;
    const std::vector<Field>& metric;
    const Scheme& scheme;
    std::string name;
};

/// Fails if the stage reads planes at neighbours whose side rules belong to another stage.
Result<CStage> describe_c_stage(const CStageRequest& request);

}  // namespace cascade
