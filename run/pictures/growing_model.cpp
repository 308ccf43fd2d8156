// The colours of all moments are at the points of the same refined mesh.
#include "core/enough_memory.h"
#include "core/write_encoded.h"
#include "export/glb.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/refined_model.h"

#include <utility>
#include <vector>

namespace cascade {

namespace {

class GrowingModel {
public:
    GrowingModel(const ModelCells& model, const MeshTexture& texture)
        : mesh_(mesh_in_files(model, texture)),
          team_(hardware_threads()),
          filter_(mesh_, model.spread().cells, team_),
          fine_(refined_for_colours(mesh_, model.spread().cells)) {}

    GlbMoment moment(const ModelLook& look) {
        GlbMoment moment;
        moment.scale = look.scale;
        moment.colours = colours_at(fine_.places, filter_, look.painted_alone(), team_);
        if (look.displaces) {
            RefinedMesh raised = raised_model(fine_, mesh_, filter_, look.heights, team_);
            moment.points = std::move(raised.mesh.points);
        }
        return moment;
    }

    Result<std::string> encode(GlbMoment last, std::span<GlbMoment> before, double seconds) {
        for (GlbMoment& each : before) each.scale /= last.scale;
        if (!last.points.empty()) fine_.mesh.points = std::move(last.points);
        GlbLook look;
        look.colours = last.colours;
        return encode_growing_glb(fine_.mesh, look, {before, seconds});
    }

private:
    SurfaceMesh mesh_;
    Team team_;
    CellFilter filter_;
    RefinedMesh fine_;
};

}  // namespace

Result<void> write_growing_model(const std::filesystem::path& path, const ModelCells& model,
                                 const MeshTexture& texture, const ModelLook& last,
                                 const ModelGrowth& growth) {
    const auto write = [&]() -> Result<void> {
        GrowingModel growing(model, texture);
        std::vector<GlbMoment> before;
        for (std::size_t k = 0; k + 1 < growth.count; ++k) {
            const auto look = growth.look(k);
            if (!look) return tl::unexpected(look.error());
            before.push_back(growing.moment(*look));
        }
        return write_encoded(path, [&] {
            return growing.encode(growing.moment(last), before, growth.seconds);
        });
    };
    return enough_memory_for(write,
                             "cannot write '" + path.string() + "': there is not enough memory");
}

}  // namespace cascade
