// The domain: a grid, a surface or a model, with its mask and its sides.
#pragma once

#include "core/axis.h"
#include "core/grid.h"
#include "core/precision.h"
#include "lang/program/growth.h"
#include "lang/program/system.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A surface in space, over which the grid is laid.
struct SurfaceSettings {
    std::array<Formula, 3> position;  ///< Made of numbers, coordinates and functions of numbers.
    bool has_metric = true;  ///< Whether operators account for the sizes of cells. If false, all
                             ///< cells count as equal squares.
    std::optional<double> unit;  ///< The length of one unit. If empty, `extent` or
                                 ///< DomainSettings::detail determines it.
    /// The longest side of the box around the corners of all cells at t = 0, in units.
    std::optional<double> extent;
    Span span;
};

/// A domain of any shape. A formula decides which cells of the grid belong to it.
struct MaskSettings {
    Formula formula;  ///< A cell belongs to the domain if the value is neither 0 nor NaN. Reads no
                      ///< items.
    Span span;        ///< The span of the expression.
};

/// The surface over which cells are spread.
enum class ModelShape : std::uint8_t {
    file,
    sphere,
    torus,
    box,
    knot,
    creature,
    leopard,
    giraffe,
    zebra,
    fish,
    frog,
    implicit
};

/// The positions of the cells.
enum class ModelCellKind : std::uint8_t {
    spread,    ///< Points spread evenly over the surface. A cell is the Voronoi region of a point
               ///< (Turk).
    faces,     ///< One in each triangle of the model.
    vertices,  ///< One at each vertex of the model.
};

/// The weights of differences between neighbours.
enum class ModelLaplacian : std::uint8_t {
    finite_volumes,  ///< Voronoi edge length / (distance · area of the cell).
    turk,            ///< Voronoi edge length, scaled so that the weights of a cell add up to 4.
};

/// The directions along which cells, or patterns, are stretched.
struct DirectionSettings {
    enum class Kind : std::uint8_t { axis, gradient, curvature_high, curvature_low, keys };
    Kind kind = Kind::axis;
    /// For `axis`, a vector. For `keys`, a position and a vector for each key.
    std::vector<double> numbers;
    std::optional<Formula> height;  ///< For `gradient`: a formula of numbers, x, y and z. The
                                    ///< direction is its gradient.
    double smoothing = 0;  ///< The standard deviation of the smoothing, in units of the model's
                           ///< longest side.
    Span span;
};

/// A surface in space whose cells are the domain: a model in a file, or a shape.
struct ModelSettings {
    ModelShape shape = ModelShape::file;
    std::string path;           ///< The path of the model's file.
    std::vector<double> sizes;  ///< The numbers of a shape: two radii of a torus, three sides of a
                                ///< box, or the radius of a knot's tube.
    std::optional<Formula> implicit;  ///< A formula that is 0 on the surface.
    ModelCellKind cells = ModelCellKind::spread;
    std::int64_t count = 16384;  ///< The number of spread cells.
    ModelLaplacian laplacian = ModelLaplacian::finite_volumes;
    std::optional<double> unit;    ///< The length of one unit. If empty, `extent` or
                                   ///< DomainSettings::detail determines it.
    std::optional<double> extent;  ///< The longest side of the model's box at t = 0, in units.
    Stance stance;                 ///< The axes of the model that become y and z of the script.
    std::optional<DirectionSettings> directions;
    double stretch = 2;  ///< The ratio of length to width of cells along the directions.
    Span span;           ///< The span of the model's name.
};

/// The cells that the operators of derivatives read on a grid.
enum class StencilKind : std::uint8_t {
    cross,      ///< The neighbours along the axes.
    isotropic,  ///< For lap, also the diagonal neighbours.
    fourth,     ///< Two cells in each direction along each axis. The errors are of fourth order.
};

struct DomainSettings {
    Grid grid;                               ///< Usually 64 × 64 and periodic.
    std::optional<ModelSettings> model;      ///< If given, the grid is linked.
    std::optional<MaskSettings> mask;        ///< If not given, the domain is the whole grid.
    std::optional<SurfaceSettings> surface;  ///< If not given, the grid is flat.
    StencilKind stencil = StencilKind::cross;
    std::optional<Growth> growth;  ///< Applies to stages that do not set lengths themselves.
    std::uint32_t seed = 1;
    Precision precision = Precision::single;  ///< The precision of all numbers of a run.
    bool fast = false;  ///< Whether steps use fewer roundings (ir/contraction.h).
    /// Along each axis, the length of a cell is the length in the script divided by this number.
    /// The lengths of the domain do not change. On surfaces and models without a unit, the mean
    /// cell has the area 1 / detail².
    std::int64_t detail = 1;
    /// The width of a cell is the width in the script times this number. The lengths of the domain
    /// do not change.
    std::int64_t coarse = 1;
    std::array<std::optional<SideSetting>, wall_count> sides;  ///< The rules for all species.
};

}  // namespace cascade
