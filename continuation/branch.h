// Follows branches of steady states through a parameter, finds where their stability changes, and
// turns into the branches that meet them there.
#pragma once

#include "continuation/corrector.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade::continuation {

enum class PointKind : std::uint8_t {
    regular,
    fold,    ///< The branch turns back.
    branch,  ///< Real eigenvalues pass 0, and other branches meet this one.
    hopf,    ///< A pair of eigenvalues passes the imaginary axis, and oscillations begin.
};

struct Point {
    Place place;
    Tangent tangent;
    PointKind kind = PointKind::regular;
    int crossing = 0;  ///< The number of eigenvalues that pass 0 at a special point.
    /// Whether the state of a branch point is the same in all cells, although the branch consists
    /// of patterns.
    bool vanishes = false;
    /// The number of eigenvalues with positive real part. Empty if they could not be found.
    std::optional<int> growing;
    std::vector<Complex> leading;  ///< The eigenvalues with the largest real parts.
    double drift = 0;              ///< See Corrector::Solved.
};

struct Branch {
    std::vector<Point> points;
    /// The index of the branch from which this branch was reached, and the index of the point on
    /// that branch. Empty for the first branch.
    std::optional<std::pair<std::size_t, std::size_t>> from;
    /// The reasons why the branch is not followed beyond its first and its last point.
    std::string begins, ends;
};

struct FollowSettings {
    double low = 0, high = 1;       ///< The range of the parameter.
    double step = 0.05;             ///< The length of the longest step, as Scales measures it.
    std::size_t most_points = 400;  ///< The largest number of points of a branch in each direction.
    std::size_t most_branches = 1;
    bool finds_stability = true;
    std::function<void(std::size_t branch, std::size_t points, double parameter)> report;
    const std::atomic<bool>* cancel = nullptr;
};

class Follower {
public:
    Follower(Corrector& corrector, FollowSettings settings)
        : corrector_(corrector), settings_(std::move(settings)) {}

    /// Follows the branch through a solved place in both directions, then the branches that meet
    /// it, then the branches that meet those, and so on, until the settings allow no further
    /// branch.
    std::vector<Branch> follow(const Corrector::Solved& start);

private:
    Point point_at(const Corrector::Solved& solved, Tangent tangent) const;
    void find_stability(Point& point, const Corrector::Solved& solved) const;
    std::optional<Point> try_point(const Point& from, double step, int& rounds) const;
    std::string go(std::vector<Point>& points, std::size_t number);
    std::optional<Point> end_at(const Point& inside, const Point& outside) const;
    std::vector<Point> events(const Point& from, const Point& to, double step) const;
    struct Event {
        double at = 0;
        Point point;
    };
    std::optional<Event> find(const Point& from, const Point& to, double step, double low,
                              const std::function<double(const Point&)>& test) const;
    std::vector<Event> crossings(const Point& from, const Point& to, double step) const;
    bool is_known(const Point& point) const;
    double unevenness(const Vector& state) const;
    bool vanishes_between(const Point& at, const Point& from, const Point& to) const;
    void turn_from(std::size_t branch, std::size_t point);
    std::vector<Direction> ways_from(const Point& point) const;
    std::optional<Point> first_on(const Point& from, Direction way) const;
    bool is_inside(const Place& place) const {
        return settings_.low <= place.parameter && place.parameter <= settings_.high;
    }
    bool is_cancelled() const { return settings_.cancel != nullptr && *settings_.cancel; }

    Corrector& corrector_;
    FollowSettings settings_;
    std::vector<Branch> branches_;
    /// The eigenvalues with positive real part at the point whose stability was found last.
    mutable std::vector<Complex> growing_before_;
    /// The branch points from which a branch was followed or at which one has ended.
    std::vector<Place> meetings_;
};

}  // namespace cascade::continuation
