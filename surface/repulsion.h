// The force between places that spread over a surface.
#pragma once

#include "core/vector2.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Two places nearer than this, in radii, are pushed apart harder, with a force that grows linearly
/// towards 0; otherwise other places could press them together for good. Even places are 0.54
/// apart.
inline constexpr float repulsion_core = 0.35F;

struct Vector2f {
    float x = 0, y = 0;
};

/// Neighbours of places: their numbers, their positions when the list was made, in radii and in the
/// frame of the place at that time, and the rotations of their own frames relative to that.
class NeighbourList {
public:
    /// Forces are computed for this many neighbours at a time, so a list has memory for as many
    /// beyond its end.
    static constexpr std::size_t together = 16;

    std::vector<std::uint32_t> numbers;
    std::vector<float> stood_x, stood_y, turn_x, turn_y;

    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    void add(std::uint32_t number, Vector2d stood, Vector2d turn);

private:
    std::size_t size_ = 0;
};

/// Sums forces; one per thread.
class Repulsion {
public:
    /// A place: the metric at it and its movement since the list was made, in radii.
    struct Pushed {
        std::uint32_t number = 0;
        float xx = 1, xy = 0, yy = 1;
        Vector2f moved;
    };

    /// The sum of the forces 1 - d of neighbours `first` … `end` - 1 at distances d < 1 in the
    /// metric, in order. `moved` has the movement of every place.
    Vector2f push_on(const Pushed& place, const NeighbourList& neighbours, std::size_t first,
                     std::size_t end, const std::vector<Vector2f>& moved);

private:
    std::vector<float> x_, y_;  ///< Movements of neighbours, then their forces.
};

}  // namespace cascade
