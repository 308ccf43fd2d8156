// Values are written to the GPU before the next run, and read when somebody looks at them.
#include "tab/gpu_executor.h"

#include "core/check.h"
#include "core/shared_plane.h"
#include "device/problem_text.h"
#include "device/wgsl_kernels.h"
#include "device/wgsl_steps.h"
#include "ir/multiply_add.h"
#include "solvers/finite.h"
#include "tab/gpu_probe.h"
#include "tab/gpu_programs.h"
#include "tab/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {
namespace {

constexpr std::int64_t least_cells = 256 * 256;

using Tell = std::function<void(const EngineOfSteps&)>;

class GpuExecutor final : public Executor {
public:
    GpuExecutor(const StepProblem& problem, std::vector<Field> species, bool keeps,
                Flushing flushing, Tell tell)
        : flushing_(flushing),
          tell_(std::move(tell)),
          species_(species.size()),
          copies_(keeps ? 3 : 2),
          problem_(&problem) {
        copies_[0] = {std::move(species), true, false};
        load();
    }

    const StepProblem& problem() const override { return inner_ ? inner_->problem() : *problem_; }
    void prepare(const StepProblem& problem) override;

    const std::vector<Field>& fetch(int copy) override;
    const std::vector<Field>& fetch(RegisterId scratch) override;
    std::vector<Field> take(int copy) override;
    void put(int copy, std::vector<Field> species) override;
    /// Only steps with estimated errors exchange registers.
    void exchange(RegisterId one, RegisterId other) override { on_thread().exchange(one, other); }
    void fill_halos(int copy, SideMoment moment) override;

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override;
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override {
        return on_thread().run_judged(clock, first, cancel);
    }
    bool is_finite(int copy) override;

    int most_threads() const override { return 1; }
    void use_threads(int) override {}
    std::vector<Tiling> tilings_to_try() const override {
        return inner_ ? inner_->tilings_to_try() : std::vector{Tiling{}};
    }
    void use_tiling(const Tiling& tiling) override {
        if (inner_) inner_->use_tiling(tiling);
    }
    int levels() const override { return inner_ ? inner_->levels() : 1; }
    Stepping stepping() const override {
        if (inner_) return inner_->stepping();
        Stepping stepping;
        stepping.words = "one step a launch on " + about_gpu();
        return stepping;
    }

private:
    /// A copy of the species. Its fields may be lent to the caller.
    struct Copy {
        std::vector<Field> fields;
        bool is_here = false;    ///< Whether `fields` are the values of the copy.
        bool is_on_gpu = false;  ///< Whether the buffer of the GPU has the values of the copy.
    };
    /// A call of run() after the values of copy `base_` were last here.
    struct Run {
        StageClock clock;
        StepPass first;
        std::size_t count = 0;
    };

    Copy& copy_of(int number) { return copies_[static_cast<std::size_t>(number)]; }
    Executor& on_thread() {
        CHECK(inner_, "steps with estimated errors are taken on the thread");
        return *inner_;
    }
    std::vector<Field> new_fields() const {
        std::vector<Field> fields;
        for (std::size_t k = 0; k < species_; ++k) fields.emplace_back(PlaneLayout(problem_->grid));
        return fields;
    }
    void load();
    void go_on_without_gpu(const std::string& why);
    void begin_from(int current);
    void add_calls(const Run& run, std::vector<std::uint32_t>& sides);
    void begin_at(int copy) {
        base_ = copy;
        runs_.clear();
    }

    Flushing flushing_;
    Tell tell_;
    std::size_t species_;
    std::vector<Copy> copies_;
    const StepProblem* problem_;
    std::optional<WgslSteps> steps_;
    std::unique_ptr<GpuPrograms> programs_;
    int newest_ = 0;  ///< The copy that is current after the last run.
    int base_ = 0;
    std::vector<Run> runs_;
    std::vector<Field> scratch_;
    std::unique_ptr<Executor> inner_;  ///< Takes the steps if the GPU cannot.
};

void GpuExecutor::prepare(const StepProblem& problem) {
    if (!inner_ && &problem == problem_) return;
    if (!inner_) fetch(newest_);
    if (inner_) return inner_->prepare(problem);
    problem_ = &problem;
    load();
}

/// Compiles the passes of the problem and makes its buffers.
void GpuExecutor::load() {
    programs_.reset();
    for (Copy& copy : copies_) copy.is_on_gpu = false;
    if (const std::string why = reason_against_wgsl(*problem_); !why.empty()) {
        return go_on_without_gpu(why);
    }
    steps_.emplace(*problem_, flushing_, species_, copies_.size());
    if (steps_->plane_words() > host_gpu_largest()) {
        constexpr double words_of_megabyte = 1e6 / 4;
        return go_on_without_gpu(
            fmt::format("its planes need {:.0f} MB, and the GPU lends {:.0f} MB in one piece",
                        static_cast<double>(steps_->plane_words()) / words_of_megabyte,
                        static_cast<double>(host_gpu_largest()) / words_of_megabyte));
    }
    const auto masks = steps_->mask_words(), uniforms = steps_->uniforms(), links = steps_->links();
    programs_ = std::make_unique<GpuPrograms>(steps_->program(), steps_->halo_program(),
                                              std::max(wgsl_call_words(*problem_), wgsl_halo_words),
                                              std::vector{steps_->plane_words(), masks.size(),
                                                          uniforms.size(), links.size()});
    if (!programs_->is_made()) return go_on_without_gpu(about_gpu());
    for (const auto& plane : steps_->constant_planes()) {
        programs_->write(plane.place, plane.words.data(), plane.words.size());
    }
    programs_->write(2, masks);
    programs_->write(3, uniforms);
    programs_->write(4, links);
    tell_({true, about_gpu()});
}

/// Repeats on the thread what the GPU has computed since values were last here.
void GpuExecutor::go_on_without_gpu(const std::string& why) {
    programs_.reset();
    const auto is_known = [&](int number) { return copy_of(number).is_here || number == base_; };
    inner_ =
        make_thread_executor(*problem_, is_known(0) ? std::move(copies_[0].fields) : new_fields(),
                             1, copies_.size() == 3);
    for (int k = 1; k < static_cast<int>(copies_.size()); ++k) {
        if (is_known(k)) inner_->put(k, std::move(copy_of(k).fields));
    }
    for (const Run& run : runs_) inner_->run(run.clock, run.first, run.count, false, nullptr);
    tell_({false, why});
}

const std::vector<Field>& GpuExecutor::fetch(int number) {
    if (inner_) return inner_->fetch(number);
    Copy& copy = copy_of(number);
    if (copy.is_here) return copy.fields;
    CHECK(copy.is_on_gpu, "a copy has values");
    if (copy.fields.empty()) copy.fields = new_fields();
    if (!programs_->read(steps_->place_of(number, 0), copy.fields)) {
        go_on_without_gpu(about_gpu());
        return inner_->fetch(number);
    }
    copy.is_here = true;
    if (number == newest_) begin_at(number);
    return copy.fields;
}

const std::vector<Field>& GpuExecutor::fetch(RegisterId scratch) {
    if (inner_) return inner_->fetch(scratch);
    if (scratch_.empty()) scratch_ = new_fields();
    if (programs_->read(steps_->place_of(scratch, CopyRoles{}), scratch_)) return scratch_;
    go_on_without_gpu(about_gpu());
    return inner_->fetch(scratch);
}

std::vector<Field> GpuExecutor::take(int number) {
    fetch(number);
    if (inner_) return inner_->take(number);
    copy_of(number).is_here = false;
    return std::move(copy_of(number).fields);
}

void GpuExecutor::put(int number, std::vector<Field> species) {
    if (inner_) return inner_->put(number, std::move(species));
    copy_of(number) = {std::move(species), true, false};
    newest_ = number;
    begin_at(number);
}

void GpuExecutor::fill_halos(int number, SideMoment moment) {
    fetch(number);
    if (inner_) return inner_->fill_halos(number, moment);
    problem_->fill_halos(copy_of(number).fields, moment);
    copy_of(number).is_on_gpu = false;
}

/// Makes a copy the newest, and writes it to the GPU if it is not there.
void GpuExecutor::begin_from(int current) {
    if (current != newest_) {
        // The run has gone back to the kept copy.
        newest_ = current;
        fetch(current);
        if (inner_) return;
        begin_at(current);
    }
    Copy& copy = copy_of(current);
    if (copy.is_on_gpu) return;
    CHECK(copy.is_here, "the current copy has values");
    for (std::size_t k = 0; k < species_; ++k) {
        programs_->write(steps_->place_of(current, k), memory_of(copy.fields[k]),
                         static_cast<std::size_t>(copy.fields[k].layout().size()));
    }
    copy.is_on_gpu = true;
}

bool GpuExecutor::run(const StageClock& clock, StepPass first, std::size_t count, bool check,
                      const std::atomic<bool>* cancel) {
    if (inner_) return inner_->run(clock, first, count, check, cancel);
    begin_from(first.roles.current);
    if (inner_) return inner_->run(clock, first, count, check, cancel);
    runs_.push_back({clock, first, count});
    std::vector<std::uint32_t> sides;
    add_calls(runs_.back(), sides);
    if (!programs_->run(sides)) go_on_without_gpu(about_gpu());
    return !check || is_finite(newest_);
}

/// Adds the calls of a run, and remembers which copies it writes.
void GpuExecutor::add_calls(const Run& run, std::vector<std::uint32_t>& sides) {
    const std::size_t passes = problem_->passes.size();
    StepPass next = run.first;
    std::vector<WgslCall> calls;
    for (std::size_t left = run.count; left > 0; --left) {
        const StepMoment moment{next.complete, run.clock.at(next.complete), run.clock.step,
                                run.clock.at(next.complete + 1), nullptr};
        calls.clear();
        steps_->add(next.pass, next.roles, moment, calls, sides);
        for (const WgslCall& call : calls) {
            programs_->add(call.is_halo ? passes : next.pass, call);
        }
        if (++next.pass < passes) continue;
        next.pass = 0;
        ++next.complete;
        next.roles.go_on();
        Copy& written = copy_of(next.roles.current);
        written.is_here = false;
        written.is_on_gpu = true;
    }
    newest_ = next.roles.current;
}

bool GpuExecutor::is_finite(int copy) {
    const std::vector<Field>& fields = fetch(copy);
    return std::all_of(fields.begin(), fields.end(), [](const Field& field) {
        return are_finite(field, Patch{{0, field.layout().row_count()}});
    });
}

/// The reason why the GPU does not take the steps of a problem. Empty if it can.
std::string reason_against_gpu(const StepProblem& problem) {
    if (problem.grid.cell_count() < least_cells) {
        return fmt::format("the GPU takes only stages of at least {} cells", least_cells);
    }
    if (const std::string why = reason_against_wgsl(problem); !why.empty()) return why;
    // Exact modules have no multiply_add with which the GPU could be compared.
    for (const StepProblem::Pass& pass : problem.passes) {
        if (multiplies_and_adds(*pass.source)) return "it joins products and sums (--fast)";
    }
    if (host_gpu_open() == 0) return about_gpu();
    return probed_gpu().flushing ? "" : probed_gpu().fault;
}

}  // namespace

MakeExecutor on_gpu(Tell tell) {
    return [tell = std::move(tell)](const StepProblem& problem, std::vector<Field> species,
                                    int most_threads, bool keeps) -> std::unique_ptr<Executor> {
        if (const std::string why = reason_against_gpu(problem); !why.empty()) {
            tell({false, why});
            return make_thread_executor(problem, std::move(species), most_threads, keeps);
        }
        return std::make_unique<GpuExecutor>(problem, std::move(species), keeps,
                                             *probed_gpu().flushing, tell);
    };
}

}  // namespace cascade
