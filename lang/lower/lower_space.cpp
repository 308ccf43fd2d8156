// Lowers functions of a cell's position, such as shapes and lattices of seeds, and random
// functions, such as noise and draws.
#include "core/check.h"
#include "core/hash.h"
#include "lang/lower/lower_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

namespace cascade::lowering {

namespace {

/// The key for one occurrence of a random function. It is the FNV-1a hash of the seed, the stage,
/// the formula's origin, and the number of the occurrence in the formula. Each of these four is
/// written as a text that ends with a line feed.
std::uint64_t random_key(std::uint32_t seed, std::string_view stage, std::string_view origin,
                         std::size_t occurrence) {
    std::uint64_t key = fnv1a(fmt::format("{}\n", seed));
    key = fnv1a(fmt::format("{}\n", stage), key);
    key = fnv1a(fmt::format("{}\n", origin), key);
    return fnv1a(fmt::format("{}\n", occurrence), key);
}

/// The random source of a node. Every occurrence of a random function in a formula draws its own
/// numbers.
Draw draw_of(KernelAssembly& assembly, const NodeInCell& in) {
    const auto& [formula, noise] = *in.graph.origin(in.id);
    const auto first = formula->nodes.begin(), last = first + in.graph.position(in.id).index() + 1;
    return {noise.every_step ? assembly.draw_word() : assembly.builder().word(0),
            random_key(assembly.program().domain.seed,
                       noise.owner.empty() ? assembly.stage().name : noise.owner, noise.origin,
                       static_cast<std::size_t>(std::count_if(first, last, is_draw)))};
}

}  // namespace

/// Lowers a shape. The last operands are the shape's sizes, and the operands before them are its
/// position.
ValueId lower_shape(KernelAssembly& assembly, const NodeInCell& in) {
    KernelBuilder& builder = assembly.builder();
    const Space space = CellPlace(assembly, in.at).space();
    const std::size_t count = in.node().operand_count;
    std::vector<ValueId> values;
    for (std::size_t k = 0; k < count; ++k) values.push_back(in.number(k));
    const auto first = [&](std::size_t n) { return std::span(values).first(n); };
    switch (in.node().function) {
        case Function::disc: return disc(builder, space, first(count - 1), values[count - 1]);
        case Function::gauss: return gauss(builder, space, first(count - 1), values[count - 1]);
        case Function::ring:
            return ring(builder, space, first(count - 2), values[count - 2], values[count - 1]);
        case Function::box:
            return box(builder, space, first(count / 2), std::span(values).last(count / 2));
        case Function::stripe:
            if (count == 2) return stripe(builder, space, values[0], values[1]);
            return turned_stripe(builder, space, values[0], values[1], values[2]);
        default: break;
    }
    CHECK(false, "lowering: every shape has a meaning");
}

/// Lowers draws. White noise in space and time has the variance strength² / (dt h^d) in a step of
/// length dt and in cells of content h^d. So the integral of the noise over a given time and area
/// has a variance that depends neither on dt nor on h.
ValueId lower_draw(KernelAssembly& assembly, const NodeInCell& in) {
    KernelBuilder& builder = assembly.builder();
    CellPlace place(assembly, in.at);
    const Draw draw = draw_of(assembly, in);
    const auto normal = [&] { return builder.random_normal(place.draw(draw.word), draw.key); };
    switch (in.node().function) {
        case Function::random: {
            const ValueId uniform = builder.random_symmetric(place.draw(draw.word), draw.key);
            return builder.add(in.number(0), builder.multiply(in.number(1), uniform));
        }
        case Function::normal: {
            const ValueId deviation = normal();
            return builder.add(in.number(0), builder.multiply(in.number(1), deviation));
        }
        case Function::white: {
            const ValueId deviation = normal();
            const ValueId share = builder.multiply(assembly.time_step(in.at), place.content());
            const ValueId spread = builder.apply(Op::square_root, share);
            return builder.divide(builder.multiply(in.number(0), deviation), spread);
        }
        case Function::noise:
            return smooth_noise(builder, place.space(), in.number(0),
                                std::get<Call>(in.node().kind).detail, draw);
        case Function::lattice:
        case Function::diamond: {
            const bool is_diamond = in.node().function == Function::diamond;
            const ValueId jitter = in.node().operand_count == 3 ? in.number(2) : builder.number(0);
            return seed_lattice(builder, place.space(),
                                is_diamond ? LatticeKind::diamond : LatticeKind::square,
                                in.number(0), in.number(1), jitter, draw);
        }
        default: break;
    }
    CHECK(false, "lowering: every random function has a meaning");
}

}  // namespace cascade::lowering
