// Converts values of cells to the order in which files list the cells, and heights to lengths of
// the model.
#include "run/pictures/model_picture.h"

#include <algorithm>

namespace cascade {

ModelLook::ModelLook(const ModelCells& model, const Canvas& canvas, ValueRange range,
                     const Palette& palette)
    : CellLook(canvas, range, palette,
               [&](const Field& field) { return cell_values(field, model); }) {
    material =
        Material(canvas.material, [&](const Field& field) { return cell_values(field, model); });
    heights = std::move(material.heights);
    scale = canvas.scales[0];
    const double unit = model.spread().unit / scale;
    for (float& height : heights) height = static_cast<float>(static_cast<double>(height) * unit);
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
    return scene_.draw(look.painted(), options, team_, copies);
}

}  // namespace cascade
