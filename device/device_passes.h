// The passes of one problem on a device: compiled kernels, constant planes, halos and aggregates.
#pragma once

#include "device/device_halos.h"
#include "device/device_planes.h"
#include "device/device_sums.h"
#include "device/problem_text.h"
#include "solvers/pass_runner.h"
#include "solvers/step_problem.h"

#include <optional>
#include <string>
#include <vector>

namespace cascade {

class DevicePasses {
public:
    /// Compiles the problem's kernels and writes its constant planes to the device. `halos` and
    /// `sums` must outlive the passes. `sums` may be null if the problem has no aggregates.
    DevicePasses(Device& device, const StepProblem& problem, const TextTarget& target,
                 DeviceHalos& halos, DeviceSums* sums);

    /// Adds one pass to the device's queue.
    void run(std::size_t pass, CopyRoles roles, const StepMoment& moment,
             const DevicePlanes& planes);

    /// Limits the rows of a launch, and thus the launch's duration.
    void limit_rows(std::int64_t rows) { rows_of_launch_ = rows; }

    /// Whether these passes were made for this problem, and their program is `text`.
    bool are_of(const StepProblem& problem, const std::string& text) const;
    /// The number of bytes of all constant planes and links.
    static std::uint64_t constant_bytes(const StepProblem& problem);

private:
    struct OfPass {
        DeviceKernel kernel;
        std::vector<StepProblem::ChangingUniform> passed;
        /// Results that have halos and are in the same buffer.
        struct Halos {
            std::optional<RegisterId> in_register;  ///< nullopt for temporaries.
            std::vector<std::size_t> results;
            HaloGroup group;
        };
        std::vector<Halos> halos;
    };

    void write_constants();
    void write_links();
    template <typename Number>
    void write_links_as();
    void add_halos(std::size_t pass);
    template <typename Number>
    void launch(OfPass& pass, CopyRoles roles, const StepMoment& moment,
                const DevicePlanes& planes);
    void fill_halos(std::size_t pass, CopyRoles roles, const StepMoment& moment,
                    const DevicePlanes& planes);
    void reduce(std::size_t pass, CopyRoles roles, const DevicePlanes& planes);
    std::int64_t origin(std::size_t plane) const;

    Device& device_;
    const StepProblem& problem_;
    TextTarget target_;
    PlaneLayout layout_;
    ConstantPlanes constants_;
    DeviceHalos& halos_;
    DeviceSums* sums_;
    std::string text_;
    std::int64_t rows_of_item_ = 1, rows_of_launch_;
    std::size_t group_ = 16;
    std::vector<OfPass> passes_;
    DeviceBuffer fields_, masks_, uniforms_, aggregates_;
    std::vector<DeviceBuffer> links_;
};

/// The number of rows that a work-item computes on a device.
std::int64_t rows_of_item(const DeviceFacts& facts, const StepProblem& problem);

}  // namespace cascade
