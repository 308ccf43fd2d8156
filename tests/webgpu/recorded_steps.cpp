// Executors that record steps.
#include "tests/webgpu/webgpu_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

namespace cascade::test {
namespace {

/// The largest number of steps of a stage that are recorded.
constexpr std::size_t most_steps = 12;

std::vector<std::uint32_t> words_of_field(const Field& field) {
    const PlaneLayout& layout = field.layout();
    std::vector<std::uint32_t> words(static_cast<std::size_t>(layout.size()));
    std::memcpy(words.data(), field.origin<float>() - layout.offset(0, 0), 4 * words.size());
    return words;
}

class RecordingExecutor final : public Executor {
public:
    RecordingExecutor(std::unique_ptr<Executor> inner, CaseFile& file, Flushing flushing,
                      std::string name, bool keeps, std::shared_ptr<RecordedStages> recorded)
        : inner_(std::move(inner)),
          file_(file),
          flushing_(flushing),
          name_(std::move(name)),
          copies_(keeps ? 3 : 2),
          recorded_(std::move(recorded)) {}

    const StepProblem& problem() const override { return inner_->problem(); }
    void prepare(const StepProblem& problem) override { inner_->prepare(problem); }
    const std::vector<Field>& fetch(int copy) override { return inner_->fetch(copy); }
    const std::vector<Field>& fetch(RegisterId scratch) override { return inner_->fetch(scratch); }
    std::vector<Field> take(int copy) override { return inner_->take(copy); }
    void put(int copy, std::vector<Field> species) override {
        inner_->put(copy, std::move(species));
    }
    void exchange(RegisterId one, RegisterId other) override { inner_->exchange(one, other); }
    void fill_halos(int copy, SideMoment moment) override { inner_->fill_halos(copy, moment); }
    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override {
        const std::size_t passes = problem().passes.size();
        const std::string reason = reason_against_wgsl(problem());
        if (!reason.empty()) recorded_->reasons.insert(reason);
        if (!reason.empty() || first.pass != 0 || count % passes != 0 || steps_ >= most_steps) {
            return inner_->run(clock, first, count, check, cancel);
        }
        WebgpuCase recorded = before(clock, first, count);
        const bool is_fine = inner_->run(clock, first, count, check, cancel);
        CopyRoles roles = first.roles;
        for (std::size_t k = 0; k < count / passes; ++k) roles.go_on();
        expect(recorded, roles.current);
        recorded.write(file_);
        ++recorded_->cases;
        steps_ += count / passes;
        return is_fine;
    }
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override {
        recorded_->reasons.insert("its steps have chosen lengths");
        return inner_->run_judged(clock, first, cancel);
    }
    bool is_finite(int copy) override { return inner_->is_finite(copy); }
    int most_threads() const override { return inner_->most_threads(); }
    void use_threads(int threads) override { inner_->use_threads(threads); }
    std::vector<Tiling> tilings_to_try() const override { return inner_->tilings_to_try(); }
    void use_tiling(const Tiling& tiling) override { inner_->use_tiling(tiling); }
    int levels() const override { return inner_->levels(); }
    Stepping stepping() const override { return inner_->stepping(); }

private:
    /// The case without its results: the programs, the planes before the steps, and the calls.
    WebgpuCase before(const StageClock& clock, StepPass next, std::size_t count) {
        const std::vector<Field>& species = inner_->fetch(next.roles.current);
        const WgslSteps steps(problem(), flushing_, species.size(), copies_);
        WebgpuCase made;
        made.name = fmt::format("{}, from step {}", name_, next.complete);
        made.program = steps.program();
        made.halo_program = steps.halo_program();
        made.planes.resize(steps.plane_words(), 0x7fabcdef);
        const auto put = [&](std::size_t place, const std::vector<std::uint32_t>& words) {
            std::copy(words.begin(), words.end(),
                      made.planes.begin() + static_cast<std::ptrdiff_t>(place));
        };
        for (std::size_t k = 0; k < species.size(); ++k) {
            put(steps.place_of(next.roles.current, k), words_of_field(species[k]));
        }
        for (const auto& plane : steps.constant_planes()) put(plane.place, plane.words);
        made.masks = steps.mask_words();
        made.uniforms = steps.uniforms();
        made.links = steps.links();
        for (; count > 0; --count) {
            const StepMoment moment{next.complete, clock.at(next.complete), clock.step,
                                    clock.at(next.complete + 1), nullptr};
            steps.add(next.pass, next.roles, moment, made.calls, made.sides);
            if (++next.pass < problem().passes.size()) continue;
            next.pass = 0;
            ++next.complete;
            next.roles.go_on();
        }
        return made;
    }

    void expect(WebgpuCase& recorded, int copy) {
        const std::vector<Field>& species = inner_->fetch(copy);
        const WgslSteps steps(problem(), flushing_, species.size(), copies_);
        for (std::size_t k = 0; k < species.size(); ++k) {
            const PlaneLayout& layout = species[k].layout();
            std::vector<std::uint8_t> is_free(static_cast<std::size_t>(layout.size()), 1);
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                const auto first = layout.offset(0, 0) + layout.row_start(row);
                const std::int64_t counted = problem().counted_in_row(row);
                std::fill_n(is_free.begin() + first, counted, std::uint8_t{0});
            }
            recorded.expected.push_back({fmt::format("species {}", k), steps.place_of(copy, k),
                                         words_of_field(species[k]), std::move(is_free)});
        }
    }

    std::unique_ptr<Executor> inner_;
    CaseFile& file_;
    Flushing flushing_;
    std::string name_;
    std::size_t copies_;
    std::shared_ptr<RecordedStages> recorded_;
    std::size_t steps_ = 0;
};

}  // namespace

MakeExecutor recording_executor(CaseFile& file, Flushing flushing, std::string name,
                                std::shared_ptr<RecordedStages> recorded) {
    return [&file, flushing, name = std::move(name),
            recorded = std::move(recorded)](const StepProblem& problem, std::vector<Field> species,
                                            int most_threads,
                                            bool keeps) -> std::unique_ptr<Executor> {
        auto inner = make_thread_executor(problem, std::move(species), most_threads, keeps);
        return std::make_unique<RecordingExecutor>(std::move(inner), file, flushing, name, keeps,
                                                   recorded);
    };
}

}  // namespace cascade::test
