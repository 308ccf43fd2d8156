// Folds, branch points and Hopf points between two points of a branch, and the branches that begin
// there.
#include "continuation/branch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cascade::continuation {

namespace {

constexpr int most_halvings = 40;
/// The least distance from a singular point, as a fraction of a step.
constexpr double beside_singular = 1e-7;
/// The length of an interval that counts as a point, as a fraction of a step.
constexpr double narrow = 1e-7;

}  // namespace

/// Finds the point between two points where a test changes its sign, at a distance of at least
/// `low` from the first one. Uses the regula falsi, but halves the test's value at an end that
/// stays (Illinois algorithm).
std::optional<Follower::Event> Follower::find(
    const Point& from, const Point& to, double step, double low,
    const std::function<double(const Point&)>& test) const {
    double high = step, at_low = test(from), at_high = test(to);
    if (!(at_low * at_high < 0)) return std::nullopt;
    const double size = std::abs(at_low) + std::abs(at_high);
    Event best{step, to};
    int side = 0;
    for (int round = 0; round < most_halvings && high - low > narrow * step; ++round) {
        double middle = (low * at_high - high * at_low) / (at_high - at_low);
        const double margin = 0.02 * (high - low);
        if (round > 10) middle = (low + high) / 2;
        middle = std::clamp(middle, low + std::min(margin, narrow * step),
                            high - std::min(margin, narrow * step));
        int rounds = 0;
        auto point = try_point(from, middle, rounds);
        // Where branches meet, the equations are singular and cannot be solved. They can be solved
        // very near that point.
        const bool is_singular = !point;
        for (double beside = beside_singular; !point && beside < 2e-3; beside *= 10) {
            point = try_point(from, middle + beside * step, rounds);
        }
        if (!point) break;
        const double value = test(*point);
        if (std::isnan(value)) break;
        best = {middle, *point};
        if (is_singular || std::abs(value) < 1e-9 * size) break;
        if ((value < 0) == (at_low < 0)) {
            low = middle;
            at_low = value;
            if (side == 1) at_high /= 2;
            side = 1;
        } else {
            high = middle;
            at_high = value;
            if (side == -1) at_low /= 2;
            side = -1;
        }
    }
    return best;
}

/// The points where eigenvalues pass the imaginary axis, in their order along the branch.
std::vector<Follower::Event> Follower::crossings(const Point& from, const Point& to,
                                                 double step) const {
    std::vector<Event> found;
    if (!from.growing || !to.growing) return found;
    const int change = *to.growing - *from.growing;
    const int sign = change > 0 ? 1 : -1;
    for (int passed = 0; passed < std::abs(change);) {
        // The eigenvalues are sorted, so this is the index of the next eigenvalue that passes.
        const auto number = static_cast<std::size_t>(sign > 0 ? *from.growing + passed
                                                              : *from.growing - 1 - passed);
        const auto test = [&](const Point& point) {
            return number < point.leading.size() ? point.leading[number].real()
                                                 : std::numeric_limits<double>::quiet_NaN();
        };
        auto event = find(from, to, step, 0, test);
        if (!event) break;
        const double span = std::abs(test(from)) + std::abs(test(to));
        // Eigenvalues that pass at the same point are one event.
        int together = 0;
        for (; passed < std::abs(change); ++passed, ++together) {
            const int next = sign > 0 ? *from.growing + passed : *from.growing - 1 - passed;
            const auto k = static_cast<std::size_t>(next);
            if (k >= event->point.leading.size()) break;
            if (std::abs(event->point.leading[k].real()) > 1e-3 * span && together > 0) break;
        }
        const Complex value = event->point.leading[number];
        const bool turns = std::abs(value.imag()) > 1e-6 * (span + std::abs(value));
        event->point.kind = turns ? PointKind::hopf : PointKind::branch;
        event->point.crossing = together;
        found.push_back(*std::move(event));
    }
    return found;
}

/// The length of a state's deviation from its means over the cells, as Scales measures it.
double Follower::unevenness(const Vector& state) const {
    const Index species = corrector_.problem().species_count();
    const Vector& weights = corrector_.scales().weights;
    double sum = 0;
    for (Index s = 0; s < species; ++s) {
        const auto every = Eigen::seq(s, Eigen::last, species);
        const Values values = state(every).array();
        sum += (weights(every).array() * (values - values.mean()).square()).sum();
    }
    return std::sqrt(sum);
}

/// Whether the state at `at` is the same in all cells, although the state of the branch before or
/// after it is not.
bool Follower::vanishes_between(const Point& at, const Point& from, const Point& to) const {
    const double beside = std::max(unevenness(from.place.state), unevenness(to.place.state));
    return beside > 1e-6 && unevenness(at.place.state) < 0.01 * beside;
}

std::vector<Point> Follower::events(const Point& from, const Point& to, double step) const {
    std::vector<Event> found = crossings(from, to, step);
    const auto turns_back = [](const Point& point) { return point.tangent.parameter; };
    if (auto turn = find(from, to, step, 0, turns_back)) {
        // At a fold, an eigenvalue passes 0 although no other branch begins there.
        const auto distance = [&](const Event& event) {
            const bool is_real = event.point.kind == PointKind::branch;
            return is_real ? std::abs(event.at - turn->at) : step;
        };
        const auto same = std::ranges::min_element(found, {}, distance);
        if (same != found.end() && distance(*same) < 0.03 * step && --same->point.crossing == 0) {
            found.erase(same);
        }
        // A symmetric branch turns back where it meets the branch of symmetric states. There the
        // orientation changes one time more often than at other branch points.
        int changes = from.tangent.orientation == to.tangent.orientation ? 0 : 1;
        for (const Event& event : found) {
            if (event.point.kind == PointKind::branch) changes += event.point.crossing;
        }
        const bool is_comparable = from.tangent.freedoms == to.tangent.freedoms;
        const bool meets =
            (is_comparable && changes % 2 == 1) || vanishes_between(turn->point, from, to);
        turn->point.kind = meets ? PointKind::branch : PointKind::fold;
        turn->point.crossing = 1;
        found.push_back(*std::move(turn));
    }
    std::ranges::sort(found, {}, &Event::at);
    std::vector<Point> points;
    for (Event& event : found) {
        event.point.vanishes =
            event.point.kind == PointKind::branch && vanishes_between(event.point, from, to);
        points.push_back(std::move(event.point));
    }
    return points;
}

bool Follower::is_known(const Point& point) const {
    return std::ranges::any_of(meetings_, [&](const Place& known) {
        const Direction way{point.place.state - known.state,
                            point.place.parameter - known.parameter};
        return corrector_.scales().length(way) < 1e-3;
    });
}

/// The directions of the branches that begin at a branch point, without the tangent of this branch:
/// changes of the state that change no rate. If there are several, takes the directions that are
/// symmetric about the first cell: stripes across each axis, and spots. If the branch itself goes
/// in such a direction, the other branch is found by changing the parameter alone.
std::vector<Direction> Follower::ways_from(const Point& point) const {
    const auto solved = corrector_.solve(point.place, point.tangent);
    if (!solved) return {};
    const auto modes = leading_modes(solved->at.jacobian, corrector_.neutral_modes(*solved), {},
                                     point.growing.value_or(0) + 10, true, settings_.cancel);
    std::vector<Mode> nearest(modes);
    std::ranges::sort(nearest, {}, [](const Mode& mode) { return std::abs(mode.value); });
    nearest.resize(std::min(nearest.size(), static_cast<std::size_t>(point.crossing)));
    std::vector<Vector> basis;
    for (const Mode& mode : nearest) {
        for (Vector part : {Vector(mode.vector.real()), Vector(mode.vector.imag())}) {
            const double length = part.norm();
            for (const Vector& known : basis) part -= known.dot(part) * known;
            if (part.norm() > 1e-3 * length && length > 1e-3) basis.push_back(part.normalized());
        }
    }
    basis.resize(std::min(basis.size(), static_cast<std::size_t>(point.crossing)));
    std::vector<Direction> ways;
    const auto add = [&](const Vector& way) {
        Direction direction{way, 0};
        corrector_.scales().normalise(direction);
        const double along = std::abs(corrector_.scales().product(direction, point.tangent));
        if (along > 0.9) direction = {Vector::Zero(way.size()), 1};
        corrector_.scales().normalise(direction);
        ways.push_back(std::move(direction));
    };
    if (basis.size() < 2) {
        for (const Vector& each : basis) add(each);
        return ways;
    }
    std::vector<Vector> known;
    for (const Vector& target : corrector_.problem().even_shapes(basis[0])) {
        Vector way = Vector::Zero(target.size());
        for (const Vector& each : basis) way += each.dot(target) * each;
        if (way.norm() < 1e-6 * target.norm()) continue;
        way.normalize();
        const bool is_new = std::ranges::none_of(known, [&](const Vector& other) {
            return std::abs(other.dot(way)) > 0.98;
        });
        if (!is_new) continue;
        add(way);
        known.push_back(std::move(way));
    }
    return ways;
}

/// The first point of the branch that begins at `from` in the direction `way`.
std::optional<Point> Follower::first_on(const Point& from, Direction way) const {
    for (double step = settings_.step; step > settings_.step / 1000; step /= 3) {
        const Place guess{from.place.state + step * way.state,
                          from.place.parameter + step * way.parameter};
        const auto solved = corrector_.solve(guess, way);
        if (!solved || !is_inside(solved->place)) continue;
        auto tangent = corrector_.tangent(*solved, way);
        if (tangent) return point_at(*solved, *std::move(tangent));
    }
    return std::nullopt;
}

/// Follows the branches that meet a point of a branch, in both directions of each.
void Follower::turn_from(std::size_t branch, std::size_t point) {
    const Point from = branches_[branch].points[point];
    meetings_.push_back(from.place);
    for (const Direction& way : ways_from(from)) {
        std::optional<double> change;
        for (const Direction& side : {way, Direction{-way.state, -way.parameter}}) {
            if (branches_.size() >= settings_.most_branches || is_cancelled()) return;
            auto first = first_on(from, side);
            if (!first) continue;
            // The other half of a symmetric branch has the same states, moved or mirrored.
            const double own = first->place.parameter - from.place.parameter;
            if (change && std::abs(own - *change) <= 1e-4 * std::abs(own) + 1e-12) continue;
            change = own;
            Branch turned{{*std::move(first)}, std::pair(branch, point), "", ""};
            turned.ends = go(turned.points, branches_.size());
            branches_.push_back(std::move(turned));
        }
    }
}

}  // namespace cascade::continuation
