// The mutex for FFTW's planner.
#include "core/transform_planner.h"

#include <mutex>

namespace cascade {
namespace {

std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

TransformPlanner::TransformPlanner() { planner().lock(); }
TransformPlanner::~TransformPlanner() { planner().unlock(); }

}  // namespace cascade
