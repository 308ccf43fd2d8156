// Sorts topologically, without recursion.
#include "lang/program/order.h"

#include <algorithm>

namespace cascade {

namespace {

enum class State : std::uint8_t { untouched, open, finished };

struct Visit {
    std::uint32_t value = 0;
    std::size_t next = 0;  ///< The index of the next dependency to visit.
};

class Sorter {
public:
    explicit Sorter(const Dependencies& reads)
        : reads_(reads), states_(reads.size(), State::untouched), in_cycle_(reads.size(), false) {}

    Order run() {
        for (std::uint32_t value = 0; value < reads_.size(); ++value) {
            if (states_[value] == State::untouched) visit_from(value);
        }
        return std::move(result_);
    }

private:
    void open(std::uint32_t value) {
        states_[value] = State::open;
        path_.push_back({value, 0});
    }

    void visit_from(std::uint32_t start) {
        open(start);
        while (!path_.empty()) {
            Visit& top = path_.back();
            if (top.next == reads_[top.value].size()) {
                states_[top.value] = State::finished;
                result_.order.push_back(top.value);
                path_.pop_back();
                continue;
            }
            const std::uint32_t needed = reads_[top.value][top.next++];
            if (states_[needed] == State::untouched) open(needed);
            else if (states_[needed] == State::open) add_cycle(needed);
        }
    }

    /// Adds the part of the path from `first` to the end as a cycle. A cycle that shares a value
    /// with a known cycle is not added, because both probably have the same cause.
    void add_cycle(std::uint32_t first) {
        std::size_t begin = path_.size();
        while (path_[begin - 1].value != first) {
            if (in_cycle_[path_[begin - 1].value]) return;
            --begin;
        }
        if (in_cycle_[first]) return;
        std::vector<std::uint32_t> cycle;
        for (std::size_t i = begin - 1; i < path_.size(); ++i) {
            cycle.push_back(path_[i].value);
            in_cycle_[path_[i].value] = true;
        }
        result_.cycles.push_back(std::move(cycle));
    }

    const Dependencies& reads_;
    std::vector<State> states_;
    std::vector<bool> in_cycle_;
    std::vector<Visit> path_;
    Order result_;
};

}  // namespace

Order topological_order(const Dependencies& reads) { return Sorter(reads).run(); }

}  // namespace cascade
