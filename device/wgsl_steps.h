// The steps of a problem as WGSL programs, the contents of their buffers, and the calls of kernels
// that a host of WebGPU makes in order. A host needs nothing else: it creates the buffers of
// wgsl_prelude.h, compiles both programs, writes a call's words to the uniform, and calls the
// kernel.
#pragma once

#include "device/prelude.h"
#include "solvers/executor.h"
#include "solvers/pass_runner.h"
#include "solvers/step_problem.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// One call of a kernel.
struct WgslCall {
    bool is_halo = false;  ///< Whether the kernel belongs to the program of halos.
    std::string kernel;
    std::vector<std::uint32_t> words;
    std::uint32_t groups_x = 1, groups_y = 1;  ///< The number of work-groups.
};

/// A call of a kernel that computes all cells of a plane. Has no name and only the first words.
WgslCall call_of_plane(const PlaneLayout& layout);

/// The reason why WebGPU cannot take the steps of a problem, as the end of a sentence. Empty if it
/// can take them.
std::string reason_against_wgsl(const StepProblem& problem);

class WgslSteps {
public:
    /// Prints the programs. reason_against_wgsl() must give no reason. The problem must outlive
    /// this object. `copies` is the number of copies of the species.
    WgslSteps(const StepProblem& problem, Flushing flushing, std::size_t species,
              std::size_t copies);

    const std::string& program() const { return program_; }
    const std::string& halo_program() const { return halo_program_; }

    /// The number of words of c_planes.
    std::size_t plane_words() const;
    /// The place in c_planes at which the memory of a species' plane begins, halo included.
    std::size_t place_of(int copy, std::size_t species) const;
    /// The place at which the memory of the first species of a register begins.
    std::size_t place_of(RegisterId id, CopyRoles roles) const;
    /// The words of a constant plane, and its place.
    struct ConstantPlane {
        std::size_t place;
        std::vector<std::uint32_t> words;
    };
    std::vector<ConstantPlane> constant_planes() const;
    // The contents of the other buffers.
    std::vector<std::uint32_t> mask_words() const;
    std::vector<std::uint32_t> uniforms() const;
    std::vector<std::uint32_t> links() const;

    /// Adds the calls of a pass and of the halos of its results. Descriptions of sides are added to
    /// `sides`, the content of c_sides.
    void add(std::size_t pass, CopyRoles roles, const StepMoment& moment,
             std::vector<WgslCall>& calls, std::vector<std::uint32_t>& sides) const;

private:
    std::size_t temporaries() const;
    std::size_t constants() const;
    void add_halo(const std::vector<std::size_t>& origins, const std::vector<SideRules>& rules,
                  std::vector<WgslCall>& calls, std::vector<std::uint32_t>& sides) const;

    const StepProblem& problem_;
    PlaneLayout layout_;
    std::size_t species_, copies_;
    std::string program_, halo_program_;
};

}  // namespace cascade
