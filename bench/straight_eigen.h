// Turing's step over linked cells, with Eigen's product of a sparse matrix and two vectors.
#pragma once

#include "bench/straight_links.h"

#include <memory>

namespace cascade::bench {

class EigenLinks {
public:
    explicit EigenLinks(const RowLinks& links);
    ~EigenLinks();
    void step(const LinkedTuring&, const LinkedPlanes&);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cascade::bench
