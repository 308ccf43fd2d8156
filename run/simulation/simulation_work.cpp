// What a step of a stage costs.
#include "run/simulation/simulation_implementation.h"

namespace cascade {

StepWork Simulation::step_work(std::uint32_t k) {
    Implementation& self = *self_;
    CHECK(self.states[k].started, "a stage is started before its steps are counted");
    KnownKernels kernels;
    // Nothing is run, so nothing need be compiled.
    const Compile note = [&kernels,
                          interpret = self.interpreted(self.grid)](const CellKernel& kernel) {
        KernelPointer made = interpret(kernel);
        kernels.emplace(made.get(), kernel);
        return made;
    };
    StageState& state = self.states[k];
    StageTimer timer(*self.program, k, state, self.tools(k, note));
    self.find_step_invariants(k);
    StepWork work = work_of(timer.problem(), kernels);
    state.step_invariants.clear();
    return work;
}

}  // namespace cascade
