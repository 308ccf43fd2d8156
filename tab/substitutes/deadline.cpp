// A tab has no threads. It computes the cells of simple shapes only, which is fast.
#include "run/domain/deadline.h"

namespace cascade {

struct Deadline::Clock {};

Deadline::Deadline(double, std::atomic<bool>&) {}
Deadline::~Deadline() = default;
bool Deadline::ends_work() { return false; }

}  // namespace cascade
