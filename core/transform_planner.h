// FFTW's planner is not thread-safe, while its transforms are.
#pragma once

namespace cascade {

/// Gives one thread sole use of FFTW's planner. While an object exists, constructors in other
/// threads wait. Code in solvers/ and measure/ holds an object while it creates or destroys FFTW's
/// plans, in any precision.
class TransformPlanner {
public:
    TransformPlanner();
    ~TransformPlanner();
    TransformPlanner(const TransformPlanner&) = delete;
    TransformPlanner& operator=(const TransformPlanner&) = delete;
};

}  // namespace cascade
