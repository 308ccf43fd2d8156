// What has grown on a model, as the files of `-o`: models, cells and baked maps for other programs.
#pragma once

#include "core/result.h"
#include "export/channels.h"
#include "picture/image.h"
#include "run/domain/model_cells.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

class CellFilter;
struct ModelLook;
struct RefinedMesh;
struct Retiled;

/// What a file of results holds.
enum class OutputKind { picture, model, cells };

/// By the ending, in upper or lower case: .png; .ply, .obj, .glb, .vtp; .npz, .cells.vtp. Nothing
/// for other names.
std::optional<OutputKind> output_kind(const std::filesystem::path& path);

/// How models are written.
struct ModelFileOptions {
    bool retile = false;    ///< Over the cells as points, instead of the model's own.
    std::int64_t bake = 0;  ///< Texels of a side of the maps of GLB files; 0: colours of points.
    static constexpr std::int64_t most_texels = 8192;
    /// Does this file get maps?
    bool is_baked(const std::filesystem::path& path) const;
};

/// Writes results of one moment. What it refers to must stay.
class ModelFileWriter {
public:
    /// `channels` are the numbers of each cell that go into files beside colours; `texts` go into
    /// maps. Throws std::bad_alloc.
    ModelFileWriter(const ModelCells& model, const ModelLook& look, std::vector<Channel> channels,
                    const ModelFileOptions& options, PngTexts texts);
    ~ModelFileWriter();

    /// A file of a model or of cells. Returns what was written: of a baked model its maps too.
    /// Fails as the writers of export/ do.
    Result<std::vector<std::filesystem::path>> write(const std::filesystem::path& path);

    /// Of all that was baked, a sentence each.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    Result<void> write_refined(const std::filesystem::path& path);
    Result<void> write_retiled(const std::filesystem::path& path);
    Result<void> write_cells(const std::filesystem::path& path);
    Result<std::vector<std::filesystem::path>> write_maps(const std::filesystem::path& path);
    const CellFilter& filter();

    const ModelCells& model_;
    SurfaceMesh turned_back_;  ///< Empty where the model was not turned.
    const SurfaceMesh& mesh_;  ///< In the coordinates of the model's file, as all files are.
    const ModelLook& look_;
    std::vector<Channel> channels_;
    ModelFileOptions options_;
    PngTexts texts_;
    Team team_;
    std::vector<std::string> warnings_;
    // Made when they are first needed.
    std::unique_ptr<CellFilter> filter_;
    std::unique_ptr<RefinedMesh> refined_;
    std::unique_ptr<Retiled> retiled_;
};

}  // namespace cascade
