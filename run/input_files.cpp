#include "run/input_files.h"

#include "picture/npy.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <string>

namespace cascade {

namespace {

/// Bytes that the system would give without swapping; 0 where it does not say.
std::uint64_t available_memory() {
    std::ifstream meminfo("/proc/meminfo");
    std::string key, unit;
    std::uint64_t kibibytes = 0;
    while (meminfo >> key >> kibibytes) {
        std::getline(meminfo, unit);
        if (key == "MemAvailable:") return kibibytes * 1024;
    }
    return 0;
}

void read_one(Script& script, const Node& node, InputFiles& files) {
    const std::string& name = script.program->texts[node.index];
    const Grid& grid = script.program->domain.grid;
    const auto array = read_npy((script.folder / name).lexically_normal());
    if (!array) {
        script.diagnostics.error(node.span, array.error().message, array.error().hint);
    } else if (array->rows != grid.height || array->columns != grid.width) {
        script.diagnostics.error(
            node.span,
            fmt::format("'{}' has {} rows and {} columns, but the grid has {} and {}", name,
                        array->rows, array->columns, grid.height, grid.width),
            fmt::format("a grid of {}, {} would fit", array->columns, array->rows));
    } else {
        files.add(node.index, to_field(*array));
    }
}

}  // namespace

Result<InputFiles> read_input_files(Script& script) {
    InputFiles files;
    std::set<std::uint32_t> seen;  // A file is read, and its fault told, once.
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        for (const Formula& formula : script.program->stages[k].items) {
            for (const Node& node : formula.nodes) {
                if (node.kind != NodeKind::call || node.function != Function::field) continue;
                const Node& path = formula.nodes[node.operands[0]];
                if (seen.insert(path.index).second) read_one(script, path, files);
            }
        }
    }
    if (script.diagnostics.has_errors()) return failure("the script's files cannot be used");
    return files;
}

Result<void> check_memory(const Program& program) {
    // Two buffers and the kept copy of every species, and every varying parameter, of all stages:
    // later stages and pictures may read any of them.
    std::uint64_t planes = 4;
    for (const Stage& stage : program.stages) {
        const System& system = program.systems[stage.system];
        for (std::uint32_t item = 0; item < system.item_count(); ++item) {
            if (system.is_species(item)) {
                planes += 3;
            } else if (!stage.uniform[item]) {
                planes += 1;
            }
        }
    }
    const PlaneLayout layout(program.domain.grid);
    const double needed = static_cast<double>(planes) * static_cast<double>(layout.size()) * 4.0;
    const auto free = static_cast<double>(available_memory());
    if (free == 0 || needed <= free) return {};
    return failure(
        fmt::format("a grid of {} × {} cells needs {:.1f} GB for this script, but {:.1f} GB are free",
                    program.domain.grid.width, program.domain.grid.height, needed / 1e9,
                    free / 1e9),
        "use a smaller grid");
}

}  // namespace cascade
