// Seed lattices. For each cell, checks the two nearest seeds along each axis.
#include "ir/lattice.h"

#include <optional>
#include <vector>

namespace cascade {
namespace {

/// One of two neighbouring seeds along an axis.
struct Candidate {
    Expression part;  ///< The seed's contribution to the hash.
    /// The distance from the cell to the seed's position before the random displacement, in the
    /// unit of coordinates.
    Expression away;
};

struct Candidates {
    std::size_t axis;
    std::vector<Candidate> both;
};

/// The two seed positions nearest to the cell. In units of the lattice, each position is an integer
/// plus `offset`.
Candidates candidates_along(const LatticeHash& hash, std::size_t axis, const LatticeAxis& lattice,
                            double offset) {
    Candidates found{axis, {}};
    const Expression beside = lattice.position - offset;
    const Expression first = lattice_floor(beside);
    for (const int next : {0, 1}) {
        const Expression index = next == 0 ? first : first + 1;
        found.both.push_back(
            {hash.part(axis, lattice_word(lattice, index)), (index - beside) * lattice.side});
    }
    return found;
}

/// Whether the distance from the cell to one seed is less than the radius. Bit k of `corner`
/// selects the candidate along axis k.
Expression is_near(const LatticeHash& hash, const std::vector<Candidates>& axes, std::size_t corner,
                   Expression squared_radius, Expression jitter) {
    const auto chosen = [&](std::size_t k) { return axes[k].both[(corner >> k) & 1]; };
    Expression parts = chosen(0).part;
    for (std::size_t k = 1; k < axes.size(); ++k) {
        parts = parts.binary(Op::bits_add, chosen(k).part);
    }
    const Expression word = hash.mixed(parts);
    std::optional<Expression> squared;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const Expression away = chosen(k).away + signed_fraction(word, k) * jitter;
        squared = squared ? *squared + away * away : away * away;
    }
    return *squared < squared_radius;
}

}  // namespace

ValueId seed_lattice(KernelBuilder& builder, const Space& space, LatticeKind kind, ValueId spacing,
                     ValueId radius, ValueId jitter, const Draw& draw) {
    const Expression side(builder, spacing);
    const Expression r(builder, radius);
    const Expression squared_radius = r * r;
    const std::vector<double> offsets =
        kind == LatticeKind::square ? std::vector<double>{0.5} : std::vector<double>{0.25, 0.75};
    std::optional<Expression> inside;
    for (std::size_t part = 0; part < offsets.size(); ++part) {
        const LatticeHash hash(builder, draw, static_cast<std::uint32_t>(part));
        std::vector<Candidates> axes;
        for (std::size_t axis = 0; axis < space.size(); ++axis) {
            if (!space[axis].has_extent) continue;
            axes.push_back(candidates_along(hash, axis, lattice_axis(builder, space[axis], side),
                                            offsets[part]));
        }
        if (axes.empty()) return builder.number(1);
        for (std::size_t corner = 0; corner < std::size_t{1} << axes.size(); ++corner) {
            const Expression near =
                is_near(hash, axes, corner, squared_radius, Expression(builder, jitter));
            inside = inside ? either(*inside, near) : near;
        }
    }
    return inside->id();
}

}  // namespace cascade
