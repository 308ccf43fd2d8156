// Copies values from the order in memory to the order of the cells.
#include "run/pictures/model_picture.h"

#include <algorithm>

namespace cascade {

ModelLook::ModelLook(const ModelCells& model, const Canvas& canvas, ValueRange range,
                     const Palette& palette)
    : channels(canvas.fields.size()), values(channels * model.count()) {
    for (std::size_t c = 0; c < channels; ++c) {
        const std::vector<double> of_cells = cell_values(canvas.fields[c], model);
        for (std::size_t k = 0; k < of_cells.size(); ++k) {
            values[channels * k + c] = static_cast<float>(of_cells[k]);
        }
    }
    if (canvas.is_colour()) {
        colour = [](std::span<const float> rgb, const SurfacePlace&) {
            const auto shown = [](float channel) { return std::clamp(channel, 0.0F, 1.0F); };
            return Colour{shown(rgb[0]), shown(rgb[1]), shown(rgb[2])};
        };
        return;
    }
    colour = [range, &palette](std::span<const float> value, const SurfacePlace&) {
        return colour_at(palette, position_in(range, value[0]));
    };
}

void ModelLook::raise(const ModelCells& model, const Field& number, ValueRange range, float bump) {
    const MeshFacts facts = facts_of(model.mesh);
    const Vector3d size = facts.high - facts.low;
    const double most = static_cast<double>(bump) * std::max({size.x, size.y, size.z});
    heights.clear();
    for (const double value : cell_values(number, model)) {
        const double part = position_in(range, static_cast<float>(value));
        heights.push_back(static_cast<float>(most * std::clamp(part, 0.0, 1.0)));
    }
}

ModelDrawer::ModelDrawer(std::shared_ptr<const ModelCells> model)
    : model_(std::move(model)),
      team_(hardware_threads()),
      scene_(model_->mesh, model_->spread().cells, team_) {}

Image ModelDrawer::draw(const ModelLook& look, const DrawOptions& options,
                        const Instances* copies) {
    return scene_.draw({look.channels, look.values, look.colour, look.heights}, options, team_,
                       copies);
}

}  // namespace cascade
