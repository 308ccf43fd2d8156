// Stores the planes of steps on a device and adds passes to its queue. The queue is emptied a few
// times a second, and no launch takes long, because drivers reset devices that do not answer.
#include "device/device_executor.h"

#include "core/check.h"
#include "device/device.h"
#include "device/device_passes.h"
#include "device/device_planes.h"
#include "device/problem_text.h"
#include "solvers/executor_failure.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <optional>
#include <utility>

namespace cascade {
namespace {

/// Calls `work`, and turns errors of OpenCL into ExecutorFailures.
template <typename Work>
auto on(const Device& device, const Work& work) {
    try {
        return work();
    } catch (const OpenclError& error) {
        throw failure_of(device.facts(), error);
    } catch (const ProgramRefused& refusal) {
        throw failure_of(device.facts(), refusal);
    }
}

std::uint64_t bytes_needed(const StepProblem& problem, std::size_t species, bool keeps) {
    const std::uint64_t plane = Field::bytes(PlaneLayout(problem.grid), problem.precision);
    const std::uint64_t registers = problem.registers + (keeps ? 1 : 0);
    return plane * (registers * species + problem.temporaries) +
           DevicePasses::constant_bytes(problem);
}

/// Throws if the planes do not fit into the device's memory.
void check_memory(const StepProblem& problem, std::size_t species, bool keeps,
                  const DeviceFacts& facts) {
    const std::uint64_t needed = bytes_needed(problem, species, keeps);
    const std::uint64_t plane = Field::bytes(PlaneLayout(problem.grid), problem.precision);
    const std::uint64_t largest = plane * std::max<std::uint64_t>(species, problem.temporaries);
    // Drivers need a part of the memory for themselves.
    const double part =
        std::max(static_cast<double>(needed) / (0.95 * static_cast<double>(facts.memory)),
                 static_cast<double>(largest) / static_cast<double>(facts.largest_buffer));
    if (part <= 1) return;
    throw ExecutorFailure(
        {fmt::format("the steps need {:.2f} GB on {}, which has {:.2f} GB in total and {:.2f} GB "
                     "in one piece",
                     static_cast<double>(needed) / 1e9, facts.name,
                     static_cast<double>(facts.memory) / 1e9,
                     static_cast<double>(facts.largest_buffer) / 1e9),
         fmt::format("use about {:.0f} cells, or leave --device out to use this machine's memory",
                     static_cast<double>(problem.grid.cell_count()) / part)});
}

class DeviceExecutor final : public Executor {
public:
    DeviceExecutor(std::shared_ptr<Device> device, const StepProblem& problem,
                   std::vector<Field> species, bool keeps)
        : device_(std::move(device)),
          target_(target_of(*device_, problem)),
          layout_(problem.grid),
          planes_(device_->open(), layout_, problem.precision, species.size(), keeps),
          halos_(*device_, target_, layout_),
          check_(*device_, target_, layout_) {
        prepare(problem);
        planes_.write(planes_.copy(0), species);
    }

    const StepProblem& problem() const override { return *problem_; }
    void prepare(const StepProblem& problem) override;

    const std::vector<Field>& fetch(int copy) override {
        return fetched_ = on(*device_, [&] { return planes_.read(planes_.copy(copy)); });
    }
    const std::vector<Field>& fetch(RegisterId scratch) override {
        return fetched_scratch_ =
                   on(*device_, [&] { return planes_.read(planes_.scratch(scratch)); });
    }
    std::vector<Field> take(int copy) override {
        return on(*device_, [&] { return planes_.read(planes_.copy(copy)); });
    }
    /// Destructors call this function, so a failure is only reported at the next step.
    void put(int copy, std::vector<Field> species) override {
        try {
            planes_.write(planes_.copy(copy), species);
        } catch (const OpenclError& error) {
            lost_ = error;
        }
    }
    void exchange(RegisterId one, RegisterId other) override { planes_.exchange(one, other); }
    void fill_halos(int copy, SideMoment moment) override;

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override;
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override;
    bool is_finite(int copy) override {
        return on(*device_,
                  [&] { return check_.are_finite(planes_.copy(copy), planes_.species()); });
    }

    int most_threads() const override { return 1; }
    void use_threads(int) override {}
    std::vector<Tiling> tilings_to_try() const override { return {Tiling{}}; }
    void use_tiling(const Tiling&) override {}
    int levels() const override { return 1; }
    Stepping stepping() const override {
        Stepping stepping;
        stepping.words = "one step a launch on " + device_->facts().name;
        return stepping;
    }

private:
    using Clock = std::chrono::steady_clock;

    static TextTarget target_of(Device& device, const StepProblem& problem) {
        TextTarget target = device.probe(problem.precision).target;
        target.has_large_planes = PlaneLayout(problem.grid).size() > 0x7fffffff;
        return target;
    }
    DeviceSums& sums() {
        if (!sums_) sums_.emplace(*device_, target_, layout_);
        return *sums_;
    }
    void run_passes(const StageClock& clock, StepPass next, std::size_t count,
                    const std::atomic<bool>* cancel);
    void wait(std::size_t launches);
    void check_lost();

    std::shared_ptr<Device> device_;
    TextTarget target_;
    PlaneLayout layout_;
    DevicePlanes planes_;
    DeviceHalos halos_;
    DeviceCheck check_;
    std::optional<DeviceSums> sums_;
    const StepProblem* problem_ = nullptr;
    /// One for each problem, because steps may return to an earlier problem.
    std::list<DevicePasses> all_passes_;
    DevicePasses* passes_ = nullptr;
    std::optional<HaloGroup> of_copies_;  ///< The halos of all species.
    std::vector<Field> fetched_, fetched_scratch_;
    std::optional<OpenclError> lost_;
    Clock::time_point began_;  ///< The time at which the queue was last empty.
    std::size_t waiting_ = 0;  ///< The number of passes in the queue.
    std::int64_t rows_of_launch_ = 0;
};

void DeviceExecutor::prepare(const StepProblem& problem) {
    if (&problem == problem_) return;
    CHECK(!problem_ || problem.grid == problem_->grid, "passes of one grid");
    if (const std::string reason = reason_against(problem, device_->facts()); !reason.empty()) {
        throw ExecutorFailure({"the device cannot go on with the stage, because " + reason,
                               "leave --device out to run the stage on threads"});
    }
    on(*device_, [&] {
        planes_.make(problem.registers, problem.temporaries);
        problem_ = &problem;
        const std::string text =
            problem_text(problem, target_, rows_of_item(device_->facts(), problem));
        const auto known =
            std::find_if(all_passes_.begin(), all_passes_.end(),
                         [&](const auto& each) { return each.are_of(problem, text); });
        if (known != all_passes_.end()) {
            passes_ = &*known;
        } else {
            constexpr std::size_t most = 4;
            if (all_passes_.size() == most) all_passes_.pop_front();
            all_passes_.emplace_back(*device_, problem, target_, halos_,
                                     problem.aggregates > 0 ? &sums() : nullptr);
            passes_ = &all_passes_.back();
        }
        if (rows_of_launch_ == 0) {
            // The first launches are small, because nothing is known yet about their duration.
            constexpr std::int64_t cells = std::int64_t{1} << 22;
            rows_of_launch_ =
                std::clamp<std::int64_t>(cells / layout_.width, 1, layout_.row_count());
        }
        passes_->limit_rows(rows_of_launch_);
    });
}

void DeviceExecutor::fill_halos(int copy, SideMoment moment) {
    if (!problem_->has_halo()) return;
    on(*device_, [&] {
        std::vector<SideRules> rules;
        std::vector<std::int64_t> origins;
        const SpeciesPlanes none(planes_.species());
        for (std::size_t k = 0; k < planes_.species(); ++k) {
            rules.push_back(problem_->sides_of(SpeciesId(k), moment, none, Patch{layout_.rows}));
            origins.push_back(static_cast<std::int64_t>(k) * layout_.size() + layout_.offset(0, 0));
        }
        if (!of_copies_) of_copies_ = halos_.group(origins, rules);
        halos_.set_rules(*of_copies_, rules);
        halos_.fill(planes_.copy(copy), *of_copies_);
    });
}

bool DeviceExecutor::run(const StageClock& clock, StepPass first, std::size_t count, bool check,
                         const std::atomic<bool>* cancel) {
    return on(*device_, [&] {
        run_passes(clock, first, count, cancel);
        if (!check) return true;
        CopyRoles roles = first.roles;
        for (std::size_t step = 0; step < count / problem_->passes.size(); ++step) roles.go_on();
        return check_.are_finite(planes_.copy(roles.current), planes_.species());
    });
}

std::vector<ErrorOfStep> DeviceExecutor::run_judged(const StageClock& clock, StepPass first,
                                                    const std::atomic<bool>* cancel) {
    return on(*device_, [&] {
        run_passes(clock, first, problem_->passes.size() - first.pass, cancel);
        const std::int64_t cells = problem_->counted_cells();
        const std::int64_t counted = problem_->grid.linked ? cells : problem_->grid.cell_count();
        std::vector<ErrorOfStep> errors;
        for (std::size_t k = 0; k < planes_.species(); ++k) {
            const std::int64_t origin =
                static_cast<std::int64_t>(k) * layout_.size() + layout_.offset(0, 0);
            const auto size_of = [&](const DeviceBuffer& buffer) {
                return root_mean_square(sums().squares({buffer, origin}, counted), cells);
            };
            const double error = size_of(planes_.scratch(*problem_->error_register));
            errors.push_back({error, size_of(planes_.copy(first.roles.target()))});
        }
        return errors;
    });
}

void DeviceExecutor::run_passes(const StageClock& clock, StepPass next, std::size_t count,
                                const std::atomic<bool>* cancel) {
    check_lost();
    began_ = Clock::now();
    waiting_ = 0;
    for (; count > 0; --count) {
        const StepMoment moment{next.complete, clock.at(next.complete), clock.step,
                                clock.at(next.complete + 1), cancel};
        passes_->run(next.pass, next.roles, moment, planes_);
        if (++waiting_ == 16) wait(waiting_);
        if (++next.pass == problem_->passes.size()) {
            next.pass = 0;
            ++next.complete;
            next.roles.go_on();
        }
    }
    if (waiting_ > 0) wait(waiting_);
}

/// Waits until the queue is empty, and adapts the length of launches to the time that the passes
/// took.
void DeviceExecutor::wait(std::size_t passes) {
    device_->open().finish();
    const Clock::time_point now = Clock::now();
    const double of_pass =
        std::chrono::duration<double>(now - began_).count() / static_cast<double>(passes);
    constexpr double longest = 0.05;
    const auto rows = static_cast<double>(layout_.row_count()) * longest / std::max(of_pass, 1e-9);
    rows_of_launch_ = std::clamp(static_cast<std::int64_t>(std::min(rows, 1e9)), std::int64_t{1},
                                 layout_.row_count());
    passes_->limit_rows(rows_of_launch_);
    began_ = now;
    waiting_ = 0;
}

void DeviceExecutor::check_lost() {
    if (lost_) throw OpenclError(*lost_);
}

}  // namespace

std::string reason_against(const StepProblem& problem, const DeviceFacts& facts) {
    if (problem.precision == Precision::binary64 && !facts.has_double) {
        return "the device has no double precision";
    }
    if (const std::string reason = reason_against_text(problem); !reason.empty()) return reason;
    const bool has_sums = problem.aggregates > 0 || problem.error_register.has_value();
    if (has_sums && !facts.has_double) {
        return "sums over all cells are taken in double precision, which the device lacks";
    }
    return "";
}

MakeExecutor on_device(std::shared_ptr<Device> device, bool may_differ,
                       std::function<void(const std::string&)> tell) {
    return [device = std::move(device), may_differ,
            tell = std::move(tell)](const StepProblem& problem, std::vector<Field> species,
                                    int most_threads, bool keeps) -> std::unique_ptr<Executor> {
        const DeviceFacts& facts = device->facts();
        if (const std::string reason = reason_against(problem, facts); !reason.empty()) {
            if (tell)
                tell(fmt::format("runs on threads instead of {}, because {}", facts.name, reason));
            return make_thread_executor(problem, std::move(species), most_threads, keeps);
        }
        return on(*device, [&]() -> std::unique_ptr<Executor> {
            const ProbeResult& probe = device->probe(problem.precision);
            if (!probe.is_exact() && !may_differ) {
                throw ExecutorFailure(
                    {fmt::format("{} is not bit-exact: {}", facts.name, probe.fault),
                     "add --fast to allow other bits, or leave --device out to get the same bits "
                     "everywhere"});
            }
            if (!probe.is_exact() && tell) {
                tell(
                    fmt::format("runs on {}, which is not bit-exact: {}", facts.name, probe.fault));
            }
            check_memory(problem, species.size(), keeps, facts);
            return std::make_unique<DeviceExecutor>(device, problem, std::move(species), keeps);
        });
    };
}

}  // namespace cascade
