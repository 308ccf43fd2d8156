// The domain: a grid, a surface or a model, its mask and its sides.
#pragma once

#include "core/axis.h"
#include "core/grid.h"
#include "core/precision.h"
#include "lang/program/system.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A surface in space on which the grid lies.
struct SurfaceSettings {
    std::array<Formula, 3> position;  ///< Of numbers, coordinates and functions of numbers.
    bool has_metric = true;           ///< False: cells count as squares.
    std::optional<double> unit;       ///< Length of one unit; empty: see DomainSettings::detail.
    Span span;
};

/// A domain of any shape: the cells of the grid that belong to it.
struct MaskSettings {
    Formula formula;  ///< Neither 0 nor NaN in cells of the domain. Reads no item.
    Span span;        ///< Of the expression.
};

/// The source of a surface over which cells are spread.
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

/// What the cells are.
enum class ModelCellKind : std::uint8_t {
    spread,    ///< Points spread evenly, each with its Voronoi region (Turk).
    faces,     ///< The triangles of the model.
    vertices,  ///< Its points.
};

/// How differences between neighbours are weighted.
enum class ModelLaplacian : std::uint8_t {
    finite_volumes,  ///< The length of the Voronoi edge over the distance and the cell's area.
    turk,            ///< Lengths of Voronoi edges, scaled so that their sum is 4.
};

/// The direction in which cells, and patterns, are stretched.
struct DirectionSettings {
    enum class Kind : std::uint8_t { axis, gradient, curvature_high, curvature_low, keys };
    Kind kind = Kind::axis;
    /// For an axis its vector; for keys groups of a position and a vector.
    std::vector<double> numbers;
    std::optional<Formula> height;  ///< For a gradient: a formula of numbers and x, y and z.
    double smoothing = 0;           ///< Standard deviation, in longest sides of the model.
    Span span;
};

/// A surface in space whose cells are the domain: the file of a model, or a shape.
struct ModelSettings {
    ModelShape shape = ModelShape::file;
    std::string path;                 ///< For a file.
    std::vector<double> sizes;        ///< Of a torus (two radii), a box (three sides) or a knot.
    std::optional<Formula> implicit;  ///< The surface is where this is 0.
    ModelCellKind cells = ModelCellKind::spread;
    std::int64_t count = 16384;  ///< Of spread cells.
    ModelLaplacian laplacian = ModelLaplacian::finite_volumes;
    std::optional<double> unit;  ///< Length of one unit; empty: see DomainSettings::detail.
    Stance stance;               ///< What of the model becomes y and z of the script.
    std::optional<DirectionSettings> directions;
    double stretch = 2;  ///< The ratio of length to width of cells along the directions.
    Span span;           ///< Of the name of the model.
};

/// The cells that operators of derivatives read on a grid.
enum class StencilKind : std::uint8_t {
    cross,      ///< Those beside the cell along the axes.
    isotropic,  ///< Those across two axes as well, in lap.
    fourth,     ///< Two cells along each axis, for errors of fourth order.
};

struct DomainSettings {
    Grid grid;                               ///< 64 × 64, periodic, unless said otherwise.
    std::optional<ModelSettings> model;      ///< Then the grid is linked.
    std::optional<MaskSettings> mask;        ///< Without one all cells of the grid.
    std::optional<SurfaceSettings> surface;  ///< Without one the plane.
    StencilKind stencil = StencilKind::cross;
    std::uint32_t seed = 1;
    Precision precision = Precision::single;  ///< Of all numbers of a run.
    bool fast = false;  ///< Steps are computed with fewer roundings (ir/contraction.h).
    /// Cells are this many times as short as the script says, along each axis, in a domain of the
    /// same lengths. On surfaces and models without a unit the mean cell has the area 1 / detail².
    std::int64_t detail = 1;
    /// Cells are this many times as wide as the script says, in a domain of the same lengths.
    std::int64_t coarse = 1;
    std::array<std::optional<SideSetting>, wall_count> sides;  ///< Of all species.
};

}  // namespace cascade
