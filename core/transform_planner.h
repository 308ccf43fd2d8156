// FFTW's planner is not thread-safe, while its transforms are.
#pragma once

namespace cascade {

/// At most one exists at a time, and further threads wait. Held while FFTW's plans of any precision
/// are created or destroyed, in solvers/ and measure/.
class TransformPlanner {
public:
    TransformPlanner();
    ~TransformPlanner();
    TransformPlanner(const TransformPlanner&) = delete;
    TransformPlanner& operator=(const TransformPlanner&) = delete;
};

}  // namespace cascade
