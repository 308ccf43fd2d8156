#include "run/c_header.h"

#include "core/check.h"
#include "run/png_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade {

namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// The name of an item as a part of a C identifier: u[2] is U_2.
std::string identifier(std::string_view item) {
    std::string text = upper(std::string(item));
    std::replace(text.begin(), text.end(), '[', '_');
    std::erase(text, ']');
    return text;
}

std::string item_path(const Program& program, const SlotSource& source) {
    if (source.kind == SlotSource::Kind::step) return "number of complete steps";
    if (source.kind == SlotSource::Kind::time) return "time t when the step begins";
    if (source.kind == SlotSource::Kind::time_step) return "length of the step";
    const Stage& stage = program.stages[source.stage];
    return fmt::format("{} of stage '{}'", program.system_of(source.stage).item_name(source.item),
                       stage.name);
}

/// Comment lines that say what each slot of a table is.
std::string slots(const Program& program, std::string_view table,
                  const std::vector<SlotSource>& sources) {
    std::string text;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        text += fmt::format(" *   {}[{}]  {}\n", table, k, item_path(program, sources[k]));
    }
    return text.empty() ? fmt::format(" *   {}     none\n", table) : text;
}

std::vector<std::string> species_names(const System& system) {
    std::vector<std::string> names;
    for (const Quantity& quantity : system.quantities) {
        if (quantity.is_species) names.push_back(quantity.name);
    }
    return names;
}

/// Numbers of the field slots whose halo must be filled before a step.
std::vector<std::size_t> halo_slots(const BoundKernel& bound) {
    std::vector<std::size_t> slots;
    for (std::size_t slot = 0; slot < bound.fields.size(); ++slot) {
        if (bound.kernel.reads_neighbours(static_cast<std::uint32_t>(slot))) slots.push_back(slot);
    }
    return slots;
}

std::string stencil_words(Stencil stencil) {
    const char* neighbours[] = {"", "(E + W)",     "(N + S)",       "((N + S) + E) + W",
                                "(U + D)", "((E + W) + U) + D", "((N + S) + U) + D",
                                "((((N + S) + E) + W) + U) + D"};
    return fmt::format("{} - {}c", neighbours[stencil.number()], 2 * stencil.axes());
}

std::string introduction(const Program& program, std::uint32_t stage, const BoundKernel& bound,
                         const std::string& name, const std::string& script) {
    const System& system = program.system_of(stage);
    std::string results;
    const auto species = species_names(system);
    for (std::size_t k = 0; k < species.size(); ++k) {
        results += fmt::format(" *   results[{}]  {} after the step\n", k, species[k]);
    }
    return fmt::format(
        "/* One step of stage '{stage}' (system {system}) of {script}, compiled by Cascade {version}.\n"
        " *\n"
        " * Layout. A plane holds one value per cell. A row starts at a multiple of 16 elements\n"
        " * and has 16 elements of padding before and at least 16 behind its cells; there is one\n"
        " * row above and one below (the halo). All planes of a call have one layout. A pointer in\n"
        " * a table is the address of cell (0, 0), aligned to 64 bytes ({name}_origin): cell\n"
        " * (column i, row j) is pointer[j * stride + i]. Allocate {name}_plane_size elements.\n"
        " *\n"
        " * Halo. Before a step, {name}_fill_halo fills columns -1 and width and rows -1 and\n"
        " * height of every field that is read at neighbours.\n"
        " *\n"
        " * Row range. {name}_rows computes rows [row_begin, row_end) of every result; threads may\n"
        " * share a step by rows. It may write into the padding behind a row, nowhere else.\n"
        " * Results must not overlap anything that is read: swap the planes after each step.\n"
        " *\n"
        " * Rounding. IEEE binary32, to nearest even, no fused multiply-add. Cascade flushes\n"
        " * denormal numbers to zero; call {name}_environment once per thread for the same bits.\n"
        " * The Laplacian is {laplacian}, in this order.\n"
        " *\n"
        "{fields}{masks}{uniforms}{results} */\n",
        fmt::arg("stage", program.stages[stage].name), fmt::arg("system", system.name),
        fmt::arg("script", script), fmt::arg("version", version()), fmt::arg("name", name),
        fmt::arg("NAME", upper(name)),
        fmt::arg("laplacian", stencil_words(program.domain.grid.stencil())),
        fmt::arg("fields", slots(program, "fields", bound.fields)),
        fmt::arg("masks", slots(program, "masks", bound.masks)),
        fmt::arg("uniforms", slots(program, "uniforms", bound.uniforms)),
        fmt::arg("results", results));
}

std::string enumeration(const std::string& prefix, const std::vector<SlotSource>& sources,
                        const Program& program, std::uint32_t stage) {
    std::string text;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const SlotSource& source = sources[k];
        if (source.kind == SlotSource::Kind::step) {
            text += fmt::format("#define {}_STEP {}\n", prefix, k);
        } else if (source.kind == SlotSource::Kind::time) {
            text += fmt::format("#define {}_T {}\n", prefix, k);
        } else if (source.kind == SlotSource::Kind::time_step) {
            text += fmt::format("#define {}_TIME_STEP {}\n", prefix, k);
        } else if (source.kind == SlotSource::Kind::item && source.stage == stage) {
            text += fmt::format(
                "#define {}_{} {}\n", prefix,
                identifier(program.system_of(source.stage).item_name(source.item)), k);
        }
    }
    return text;
}

constexpr const char* body = R"(
#ifndef {NAME}_H
#define {NAME}_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>
#endif

#ifdef __cplusplus
extern "C" {{
#endif

{counts}
/* Elements from a row to the next. */
static inline int64_t {name}_stride(int64_t width) {{ return (width + 15) / 16 * 16 + 32; }}

/* Elements of a plane. */
static inline size_t {name}_plane_size(int64_t width, int64_t height) {{
    return (size_t)((height + 2) * {name}_stride(width));
}}

/* Element number of cell (0, 0) in a plane that starts on a multiple of 64 bytes. */
static inline int64_t {name}_origin(int64_t width) {{ return {name}_stride(width) + 16; }}

/* Computes rows [row_begin, row_end) of a step. */
void {name}_rows(const float *const *fields, const unsigned char *const *masks,
                 const float *uniforms, float *const *results, int64_t width, int64_t stride,
                 int64_t row_begin, int64_t row_end);

/* Flushes denormal numbers to zero on this thread, as Cascade does. */
static inline void {name}_environment(void) {{
#if defined(__x86_64__) || defined(__i386__)
    _mm_setcsr((_mm_getcsr() & ~0x6000u) | 0x8040u);
#endif
}}

/* Fills the halo of one plane, given its cell (0, 0). periodic: 1 joins opposite sides, 0 lets
 * nothing flow through them. */
static inline void {name}_fill_halo(float *cells, int64_t width, int64_t height, int periodic) {{
    const int64_t stride = {name}_stride(width);
    const size_t row = (size_t)width * sizeof(float);
    int64_t j;
    for (j = 0; j < height; ++j) {{
        float *r = cells + j * stride;
        r[-1] = periodic ? r[width - 1] : r[0];
        r[width] = periodic ? r[0] : r[width - 1];
    }}
    memcpy(cells - stride, periodic ? cells + (height - 1) * stride : cells, row);
    memcpy(cells + height * stride, periodic ? cells : cells + (height - 1) * stride, row);
}}

/* One whole step on one thread: fills the halos, then computes all rows. */
static inline void {name}_step(float *const *fields, const unsigned char *const *masks,
                               const float *uniforms, float *const *results, int64_t width,
                               int64_t height, int periodic) {{
{halos}    {name}_rows((const float *const *)fields, masks, uniforms, results, width,
         {name}_stride(width), 0, height);
}}

#ifdef __cplusplus
}}
#endif

#endif
)";

}  // namespace

std::string c_header(const Program& program, std::uint32_t stage, const BoundKernel& bound,
                     const std::string& name, const std::string& script) {
    const std::string big = upper(name);
    std::string counts = fmt::format(
        "#define {0}_FIELDS {1}\n#define {0}_MASKS {2}\n#define {0}_UNIFORMS {3}\n"
        "#define {0}_RESULTS {4}\n",
        big, bound.fields.size(), bound.masks.size(), bound.uniforms.size(),
        bound.kernel.results.size());
    counts += "/* Slots by name. */\n";
    counts += enumeration(big + "_FIELD", bound.fields, program, stage);
    counts += enumeration(big + "_MASK", bound.masks, program, stage);
    counts += enumeration(big + "_UNIFORM", bound.uniforms, program, stage);
    std::string halos;
    for (const std::size_t slot : halo_slots(bound)) {
        halos += fmt::format("    {}_fill_halo(fields[{}], width, height, periodic);\n", name, slot);
    }
    return introduction(program, stage, bound, name, script) +
           fmt::format(fmt::runtime(body), fmt::arg("name", name), fmt::arg("NAME", big),
                       fmt::arg("counts", counts), fmt::arg("halos", halos));
}

}  // namespace cascade
