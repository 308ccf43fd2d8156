// Writes the content of a picture (a model, crawling cells, a body or a plane) to those files of
// option `-o` that other programs read as models.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/model_files.h"
#include "run/pictures/painter.h"
#include "run/pictures/written_files.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <functional>

namespace cascade {

struct ShownThings {
    const Simulation& simulation;
    Painter& painter;
    const Canvas& canvas;        ///< The painter's last canvas of the simulation.
    const MeshTexture& texture;  ///< Replaces the model's texture coordinates, unless it is empty.
    const ModelFileOptions& options;
    PngTexts texts;  ///< Texts that are written into maps.
    /// Whether the number of the canvas is also written, under the name `shown`, for models and
    /// bodies.
    bool has_number = false;
};

using FileWriter = std::function<Result<WrittenFiles>(const std::filesystem::path&)>;

/// Returns a function that writes one file. Data that several files need is computed only once. The
/// references in `shown` must outlive the function.
FileWriter writer_of(ShownThings shown);

}  // namespace cascade
