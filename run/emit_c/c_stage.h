// A compiled stage as a C program sees it: tables of planes and numbers, kernels, and the bodies of
// the functions that go through its passes. What is done in which order is that of a run: the same
// plans, bound in the same way.
#pragma once

#include "core/result.h"
#include "core/side.h"
#include "ir/cell_kernel.h"
#include "lang/program/program.h"
#include "run/domain/input_files.h"
#include "run/emit_c/known_numbers.h"
#include "solvers/scheme.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// An entry of a table: `identifier` is its place in C, as in NAME_PLANE_BETA.
struct CEntry {
    std::string identifier;
    std::string meaning;    ///< In words, for the header's comment.
    bool is_given = false;  ///< Nothing computes it: the program sets it before anything reads it.
};

struct CNumber : CEntry {
    float value = 0;
};

struct CPlane : CEntry {
    std::string data;  ///< Constant numbers of the object file that fill it; empty for none.
};

/// Constants of the object file, cell after cell.
struct CData {
    std::string name;
    std::vector<float> values;
};

/// A kernel under the name of its C function.
struct CKernel {
    std::string name;
    CellKernel kernel;
};

struct CStage {
    std::string name;  ///< Of the struct, and before all other names.
    std::vector<CEntry> species;
    std::vector<CNumber> numbers;  ///< What is the same in all cells.
    std::vector<CPlane> planes;    ///< What varies and no step changes.
    std::vector<CEntry> masks;
    std::vector<CData> data;
    std::vector<CKernel> kernels;
    /// By species; empty where the boundary of the domain holds for all.
    std::vector<std::array<SideKind, side_count>> sides;
    std::uint32_t side_planes = 0;  ///< Values of sides that vary along them.
    std::uint32_t scratch_registers = 0;
    std::uint32_t temporaries = 0;
    std::uint32_t step_aggregates = 0;
    bool reduces = false;               ///< Something is taken together over the domain.
    std::optional<std::size_t> speed;   ///< Its number, where it is the same in all cells.
    std::optional<std::size_t> frozen;  ///< The same, where it is not known to be 0.
    std::string start;                  ///< Statements that compute the starting values.
    std::string step;  ///< Statements that take a step, up to exchanging registers.
};

/// What a stage needs to be written down in C.
struct CStageRequest {
    const Program& program;  ///< With the parameters that shall vary marked so.
    std::uint32_t stage = 0;
    const KnownNumbers& numbers;  ///< Of the stages up to this one.
    const InputFiles& files;
    const std::vector<Field>& metric;
    const Scheme& scheme;
    std::string name;
};

/// Fails where the stage reads, at neighbours, what lies beyond sides that another stage's values
/// decide.
Result<CStage> describe_c_stage(const CStageRequest& request);

}  // namespace cascade
