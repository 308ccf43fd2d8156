// Implicit Euler steps, solved by conjugate gradients.
#include "surface/graph_diffusion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

constexpr int implicit_steps = 4;
constexpr double residual_tolerance = 1e-6;
constexpr double rounding = 1e-14;
constexpr int most_gradient_rounds = 2'000;
/// The longest time, in units of the total mass. After this time diffusion is complete.
constexpr double longest_time = 100;

/// Sums are taken over blocks of this many nodes, so that they have the same bits with any number
/// of threads.
constexpr std::size_t block = 2'048;

/// The smallest number of nodes per thread. With fewer nodes, synchronisation takes longer than the
/// work.
constexpr std::size_t least_for_thread = 50'000;

double product(double a, double b) { return a * b; }
double inner(double a, double b) { return a * b; }
double inner(Vector2d a, Vector2d b) { return dot(a, b); }

template <typename Number>
class ImplicitStep {
public:
    /// `unit` is the mean mass, by which masses are divided.
    ImplicitStep(const DiffusionGraph<Number>& graph, double time, double unit, Team& team)
        : graph_(graph),
          time_(time / unit),
          unit_(unit),
          team_(team),
          threads_(static_cast<int>(std::clamp<std::size_t>(
              graph.masses.size() / least_for_thread, 1, static_cast<std::size_t>(team.size())))),
          diagonal_(graph.masses.size()),
          blocks_((graph.masses.size() + block - 1) / block) {
        for (std::size_t k = 0; k < diagonal_.size(); ++k) {
            diagonal_[k] = mass(k);
            for (std::size_t l = first(k); l < graph.ends[k]; ++l) {
                diagonal_[k] += time_ * graph.links[l].weight;
            }
        }
    }

    void solve(std::vector<Number>& values, const std::atomic<bool>& cancel) {
        const std::size_t count = values.size();
        // The initial residual of mass · values − (mass + time · L) values.
        std::vector<Number> rest(count), towards(count), image(count);
        const double scale = sum([&](std::size_t k) {
            rest[k] = rest_at(values, k);
            towards[k] = rest[k] * inverse(k);
            return inner(values[k], values[k]) * mass(k);
        });
        double gain = sum([&](std::size_t k) { return inner(rest[k], towards[k]); });
        const double enough =
            residual_tolerance * residual_tolerance * gain + rounding * rounding * scale;
        for (int round = 0; round < most_gradient_rounds && gain > enough && !cancel; ++round) {
            const double bend = sum([&](std::size_t k) {
                image[k] = towards[k] * mass(k) - rest_at(towards, k);
                return inner(image[k], towards[k]);
            });
            if (!(bend > 0)) break;
            const double part = gain / bend;
            const double next = sum([&](std::size_t k) {
                values[k] = values[k] + towards[k] * part;
                rest[k] = rest[k] - image[k] * part;
                return inner(rest[k], rest[k]) * inverse(k);
            });
            const double turn = next / gain;
            gain = next;
            each([&](std::size_t k) { towards[k] = rest[k] * inverse(k) + towards[k] * turn; });
        }
    }

private:
    std::size_t first(std::size_t k) const { return k == 0 ? 0 : graph_.ends[k - 1]; }
    double mass(std::size_t k) const { return graph_.masses[k] / unit_; }
    double inverse(std::size_t k) const { return diagonal_[k] > 0 ? 1 / diagonal_[k] : 0; }

    /// −time · (L v)_i at node i = k, where L is the graph's Laplacian: (L v)_i = Σ_j (weight_ij
    /// v_i − coupling_ij v_j).
    Number rest_at(const std::vector<Number>& v, std::size_t k) const {
        Number flow{};
        for (std::size_t l = first(k); l < graph_.ends[k]; ++l) {
            const GraphLink<Number>& link = graph_.links[l];
            flow = flow + product(link.coupling, v[link.neighbour]) - v[k] * link.weight;
        }
        return flow * time_;
    }

    template <typename Work>
    void each(const Work& work) {
        sum([&](std::size_t k) {
            work(k);
            return 0.0;
        });
    }

    template <typename Term>
    double sum(const Term& term) {
        const auto sum_part = [&](int thread) {
            const RowRange part =
                split_rows(static_cast<std::int64_t>(blocks_.size()), thread, threads_);
            for (auto b = static_cast<std::size_t>(part.begin);
                 b < static_cast<std::size_t>(part.end); ++b) {
                const std::size_t end = std::min((b + 1) * block, diagonal_.size());
                double total = 0;
                for (std::size_t k = b * block; k < end; ++k) total += term(k);
                blocks_[b] = total;
            }
        };
        team_.run(sum_part, threads_);
        return std::accumulate(blocks_.begin(), blocks_.end(), 0.0);
    }

    const DiffusionGraph<Number>& graph_;
    double time_, unit_;
    Team& team_;
    int threads_;
    std::vector<double> diagonal_;
    std::vector<double> blocks_;
};

template <typename Number>
std::vector<Number> diffuse(const DiffusionGraph<Number>& graph, std::vector<Number> values,
                            double time, Team& team, const std::atomic<bool>& cancel) {
    const double total = std::accumulate(graph.masses.begin(), graph.masses.end(), 0.0);
    if (!(time > 0) || !(total > 0) || values.empty()) return values;
    ImplicitStep<Number> step(graph, std::min(time, longest_time * total) / implicit_steps,
                              total / static_cast<double>(values.size()), team);
    for (int k = 0; k < implicit_steps && !cancel; ++k) step.solve(values, cancel);
    return values;
}

}  // namespace

std::vector<double> diffused(const DiffusionGraph<double>& graph, std::vector<double> values,
                             double time, Team& team, const std::atomic<bool>& cancel) {
    return diffuse(graph, std::move(values), time, team, cancel);
}

std::vector<Vector2d> diffused(const DiffusionGraph<Vector2d>& graph, std::vector<Vector2d> values,
                               double time, Team& team, const std::atomic<bool>& cancel) {
    return diffuse(graph, std::move(values), time, team, cancel);
}

}  // namespace cascade
