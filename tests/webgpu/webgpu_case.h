// A case for tests/webgpu/run_cases.mjs: programs in WGSL, the contents of their buffers, calls of
// kernels, and the planes that they must write.
#pragma once

#include "core/plane.h"
#include "device/prelude.h"
#include "device/wgsl_steps.h"
#include "ir/cell_kernel.h"
#include "solvers/executor.h"
#include "tests/support/case_file.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace cascade::test {

/// In the file, a case is: its name; both programs; the words of c_planes, c_mask_words,
/// c_uniforms, c_links and c_sides; the number of calls, and for each 1 if it is of the program of
/// halos, the kernel, its words and the numbers of work-groups; the number of expected planes, and
/// for each its name, its place, its words, and a list with 1 for each word that may be anything.
struct WebgpuCase {
    struct Expected {
        std::string name;
        std::size_t place = 0;
        std::vector<std::uint32_t> words;
        std::vector<std::uint8_t> is_free;
    };
    std::string name, program, halo_program;
    std::vector<std::uint32_t> planes, masks, uniforms, links, sides;
    std::vector<WgslCall> calls;
    std::vector<Expected> expected;

    void write(CaseFile& file) const;
};

/// A program of all kernels, each with hostile inputs of its own, and the interpreter's results.
WebgpuCase case_of_kernels(const std::vector<CellKernel>& kernels, const Grid& grid,
                           Flushing flushing, std::uint64_t seed, std::string name);

/// A kernel on two fields of numbers that are difficult to round, and the interpreter's results.
WebgpuCase probing_case(Flushing flushing);

/// How many cases the stages of a script gave, and why other steps gave none.
struct RecordedStages {
    int cases = 0;
    std::set<std::string> reasons;  ///< Why steps were not recorded.
};

/// Makes executors on threads that write their first steps as cases.
MakeExecutor recording_executor(CaseFile& file, Flushing flushing, std::string name,
                                std::shared_ptr<RecordedStages> recorded);

}  // namespace cascade::test
