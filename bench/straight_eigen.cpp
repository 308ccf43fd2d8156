#include "bench/straight_eigen.h"

#include <Eigen/SparseCore>

#include <vector>

namespace cascade::bench {

using Vector = Eigen::Map<Eigen::ArrayXf>;
using ConstVector = Eigen::Map<const Eigen::ArrayXf>;

struct EigenLinks::State {
    Eigen::SparseMatrix<float, Eigen::RowMajor> laplacian;
    Eigen::VectorXf lap_u, lap_v;
};

EigenLinks::EigenLinks(const RowLinks& links) : state_(std::make_unique<State>()) {
    std::vector<Eigen::Triplet<float>> entries;
    std::uint32_t link = 0;
    for (std::int64_t i = 0; i < links.cells; ++i) {
        float sum = 0;
        const auto row = static_cast<int>(i);
        for (; link < links.ends[i]; ++link) {
            entries.emplace_back(row, links.targets[link], links.weights[link]);
            sum += links.weights[link];
        }
        entries.emplace_back(row, row, -sum);
    }
    state_->laplacian.resize(links.cells, links.cells);
    state_->laplacian.setFromTriplets(entries.begin(), entries.end());
    state_->laplacian.makeCompressed();
}

EigenLinks::~EigenLinks() = default;

void EigenLinks::step(const LinkedTuring& p, const LinkedPlanes& planes) {
    const Eigen::Index cells = state_->laplacian.rows();
    const ConstVector u(planes.now[0], cells), v(planes.now[1], cells), beta(planes.beta, cells);
    state_->lap_u.noalias() = state_->laplacian * u.matrix();
    state_->lap_v.noalias() = state_->laplacian * v.matrix();
    Vector(planes.next[0], cells) =
        u + p.step * (p.s * (16 - u * v) + p.diffusion_u * state_->lap_u.array());
    Vector(planes.next[1], cells) =
        v + p.step * (p.s * (u * v - v - beta) + p.diffusion_v * state_->lap_v.array());
}

}  // namespace cascade::bench
