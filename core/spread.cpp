// Merging of two sets of values.
#include "core/spread.h"

namespace cascade {

void Spread::add(const Spread& other) {
    if (other.count == 0) return;
    if (count == 0) {
        *this = other;
        return;
    }
    const double total = count + other.count;
    const double apart = other.mean - mean;
    squares += other.squares + apart * apart * (count * other.count / total);
    mean += apart * (other.count / total);
    count = total;
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
}

}  // namespace cascade
