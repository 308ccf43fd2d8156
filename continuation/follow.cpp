// Takes steps along a branch. Their lengths depend on the effort of Newton's method and on the bend
// of the branch.
#include "continuation/branch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::continuation {

namespace {

constexpr double shortest_step = 1e-7;
/// The least cosine of the angle between the tangents at both ends of a step.
constexpr double least_cosine = 0.96;
constexpr int few_rounds = 4, many_rounds = 7;
constexpr int kept_eigenvalues = 16;

}  // namespace

void Follower::find_stability(Point& point, const Corrector::Solved& solved) const {
    if (!settings_.finds_stability) return;
    const std::vector<NeutralMode> neutral = corrector_.neutral_modes(solved);
    // Finds the eigenvalues of the reaction in single cells. They give the fastest growth, and the
    // frequency with which oscillations may begin.
    const Index species = corrector_.problem().species_count();
    const Index cells = corrector_.problem().cell_count();
    std::vector<Matrix> local(static_cast<std::size_t>(cells), Matrix::Zero(species, species));
    const SparseColumns& jacobian = solved.at.jacobian;
    for (Index column = 0; column < jacobian.cols(); ++column) {
        for (SparseColumns::InnerIterator entry(jacobian, column); entry; ++entry) {
            local[static_cast<std::size_t>(entry.row() / species)](entry.row() % species,
                                                                   column % species) +=
                entry.value();
        }
    }
    Complex turning = -1e300;
    double growth = 0;
    for (Index k = 0; k < cells; k += std::max<Index>(1, cells / 64)) {
        for (const Complex value : eigenvalues_of(local[static_cast<std::size_t>(k)])) {
            growth = std::max(growth, value.real());
            if (value.imag() > 0 && value.real() > turning.real()) turning = value;
        }
    }
    std::vector<Complex> places{growth};
    if (turning.imag() > 0) places.emplace_back(0, turning.imag());
    // Eigenvalues that have moved far from 0 are near eigenvalues of the previous point.
    places.insert(places.end(), growing_before_.begin(), growing_before_.end());
    const auto modes = leading_modes(solved.at.jacobian, neutral, places, kept_eigenvalues, false,
                                     settings_.cancel);
    if (modes.empty()) return;
    point.growing = 0;
    for (const Mode& mode : modes) {
        if (mode.value.real() > 0) ++*point.growing;
        point.leading.push_back(mode.value);
    }
    const auto kept = static_cast<std::size_t>(*point.growing + kept_eigenvalues);
    if (point.leading.size() > kept) point.leading.resize(kept);
    growing_before_.assign(point.leading.begin(), point.leading.begin() + *point.growing);
    for (Complex& value : growing_before_) value = {value.real(), std::abs(value.imag())};
}

Point Follower::point_at(const Corrector::Solved& solved, Tangent tangent) const {
    Point point;
    point.place = solved.place;
    point.tangent = std::move(tangent);
    point.drift = solved.drift;
    find_stability(point, solved);
    return point;
}

/// The point of the branch at the distance `step` from the point `from`, along the tangent of
/// `from`. Empty if there is none, or after a cancellation.
std::optional<Point> Follower::try_point(const Point& from, double step, int& rounds) const {
    if (is_cancelled()) return std::nullopt;
    const Place guess{from.place.state + step * from.tangent.state,
                      from.place.parameter + step * from.tangent.parameter};
    const auto solved = corrector_.solve(guess, from.tangent);
    if (!solved) return std::nullopt;
    rounds = solved->rounds;
    auto tangent = corrector_.tangent(*solved, from.tangent);
    if (!tangent) return std::nullopt;
    const bool is_bent = corrector_.scales().product(*tangent, from.tangent) < least_cosine;
    if (is_bent && step > 100 * shortest_step) return std::nullopt;
    return point_at(*solved, *std::move(tangent));
}

/// The point between two points of a branch at which the branch leaves the parameter's range.
std::optional<Point> Follower::end_at(const Point& inside, const Point& outside) const {
    const double end = outside.place.parameter > settings_.high ? settings_.high : settings_.low;
    const double span = outside.place.parameter - inside.place.parameter;
    // If branches meet exactly at the end of the range, a point can be computed only very near the
    // end.
    for (const double less : {0.0, 1e-7}) {
        const double at = end - less * (end - inside.place.parameter);
        const double share = (at - inside.place.parameter) / span;
        const Place guess{inside.place.state + share * (outside.place.state - inside.place.state),
                          at};
        const auto solved = corrector_.solve(guess, {Vector::Zero(guess.state.size()), 1});
        if (!solved) continue;
        auto tangent = corrector_.tangent(*solved, inside.tangent);
        if (tangent) return point_at(*solved, *std::move(tangent));
    }
    return std::nullopt;
}

/// Adds points after the last one, in the direction of its tangent. Returns the reason why the
/// branch ends.
std::string Follower::go(std::vector<Point>& points, std::size_t number) {
    const Place begin = points.back().place;
    double step = std::min(settings_.step, 0.01), farthest = 0;
    for (std::size_t count = 0; count < settings_.most_points; ++count) {
        if (is_cancelled()) return "interrupted";
        const Point from = points.back();
        int rounds = 0;
        std::optional<Point> next;
        while (!(next = try_point(from, step, rounds)) && step > shortest_step) step /= 2;
        const std::vector<Point> passed = next ? events(from, *next, step) : std::vector<Point>();
        if (is_cancelled()) return "interrupted";
        if (!next) return fmt::format("no state is found beyond {:.6g}", from.place.parameter);
        for (const Point& event : passed) {
            if (!is_inside(event.place)) continue;
            const bool ends = event.kind == PointKind::branch && is_known(event);
            points.push_back(event);
            if (ends) return "it meets another branch";
            const bool turns = from.tangent.parameter * next->tangent.parameter < 0;
            if (event.vanishes && turns) return "the pattern vanishes";
        }
        if (!is_inside(next->place)) {
            if (auto end = end_at(from, *next)) points.push_back(*std::move(end));
            return "the range of the parameter ends";
        }
        points.push_back(*next);
        if (settings_.report) settings_.report(number, points.size(), next->place.parameter);
        const Direction way{next->place.state - begin.state,
                            next->place.parameter - begin.parameter};
        const double distance = corrector_.scales().length(way);
        if (farthest > 3 * settings_.step && distance < 0.6 * step) return "the branch is closed";
        farthest = std::max(farthest, distance);
        if (rounds <= few_rounds) step = std::min(settings_.step, 1.5 * step);
        if (rounds >= many_rounds) step /= 2;
    }
    return fmt::format("{} points are enough", settings_.most_points);
}

std::vector<Branch> Follower::follow(const Corrector::Solved& start) {
    const Direction up{Vector::Zero(start.place.state.size()), 1};
    auto tangent = corrector_.tangent(start, up);
    if (!tangent) return {};
    Branch first;
    std::vector<Point> ahead{point_at(start, *tangent)}, behind = ahead;
    behind[0].tangent.reverse();
    branches_.emplace_back();
    first.begins = go(behind, 0);
    if (first.begins == "the branch is closed") {
        first.ends = first.begins;
    } else {
        first.ends = go(ahead, 0);
    }
    for (std::size_t k = behind.size(); k > 1; --k) {
        behind[k - 1].tangent.reverse();
        first.points.push_back(std::move(behind[k - 1]));
    }
    std::ranges::move(ahead, std::back_inserter(first.points));
    branches_[0] = std::move(first);
    for (std::size_t branch = 0; branch < branches_.size(); ++branch) {
        for (std::size_t k = 0; k < branches_[branch].points.size(); ++k) {
            if (branches_.size() >= settings_.most_branches || is_cancelled()) break;
            const Point& point = branches_[branch].points[k];
            if (point.kind == PointKind::branch && !is_known(point)) turn_from(branch, k);
        }
    }
    return std::move(branches_);
}

}  // namespace cascade::continuation
