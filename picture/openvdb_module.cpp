// The module that uses OpenVDB (picture/vdb.h).
#include "core/hash.h"
#include "core/version.h"
#include "picture/vdb.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <new>
#include <sstream>
#include <type_traits>

namespace cascade {

namespace {

/// Makes OpenVDB's function for writing to any stream accessible.
struct Archive : openvdb::io::Archive {
    using openvdb::io::Archive::write;
};

/// A grid of all cells inside the domain. Adjacent voxels with equal values become tiles.
template <typename Number>
openvdb::GridBase::Ptr grid_of(const Plane<Number>& cells, const VdbVolume& volume) {
    using Grid =
        std::conditional_t<std::is_same_v<Number, float>, openvdb::FloatGrid, openvdb::DoubleGrid>;
    const typename Grid::Ptr grid = Grid::create();
    auto voxels = grid->getAccessor();
    const PlaneLayout& layout = cells.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const std::uint8_t* const inside = volume.inside ? volume.inside->row(row) : nullptr;
        const auto j = static_cast<int>(row % layout.height);
        const auto k = static_cast<int>(row / layout.height);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            if (inside && inside[i] == 0) continue;
            const Number value = cells.row(row)[i];
            voxels.setValueOn({static_cast<int>(i), j, k},
                              std::isnan(value) ? std::numeric_limits<Number>::quiet_NaN() : value);
        }
    }
    grid->pruneGrid();
    return grid;
}

openvdb::GridBase::Ptr grid_of(const VolumeArray& array, const VdbVolume& volume) {
    auto grid = array.field->visit([&](const auto& cells) { return grid_of(cells, volume); });
    grid->setName(array.name);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    // OpenVDB's voxels have their centres at integers, but cells have their centres half-way
    // between integers.
    const openvdb::Vec3d side(volume.spacing.data());
    const bool is_cube = side[0] == side[1] && side[0] == side[2];
    const auto place = openvdb::math::Transform::createLinearTransform(is_cube ? side[0] : 1);
    if (!is_cube) place->postScale(side);
    place->postTranslate(side / 2);
    grid->setTransform(place);
    return grid;
}

openvdb::MetaMap metadata_of(const VdbVolume& volume) {
    openvdb::MetaMap metadata;
    for (const auto& [name, text] : volume.texts) {
        metadata.insertMeta(name, openvdb::StringMetadata(text));
    }
    metadata.insertMeta("stage", openvdb::StringMetadata(volume.stage));
    metadata.insertMeta("step", openvdb::Int64Metadata(volume.step));
    if (!std::isnan(volume.time)) metadata.insertMeta("t", openvdb::DoubleMetadata(volume.time));
    return metadata;
}

/// Replaces the identifier of a file, which OpenVDB chooses at random, with a hash of the content.
/// So equal volumes give equal bytes.
void set_identifier(std::string& file) {
    // The identifier follows the magic number, three versions and a flag.
    constexpr std::size_t begin = 21;
    constexpr std::size_t end = begin + 36;
    const std::string_view content = std::string_view(file).substr(end);
    const std::uint64_t first = fnv1a(content);
    const std::string digits = fmt::format("{:016x}{:016x}", first, fnv1a(content, first));
    std::size_t digit = 0;
    for (std::size_t n = begin; n < end; ++n) {
        if (file[n] != '-') file[n] = digits[digit++];
    }
}

Result<std::string> encode(const VdbVolume& volume) {
    try {
        openvdb::initialize();
        openvdb::GridPtrVec grids;
        for (const VolumeArray& array : volume.arrays) grids.push_back(grid_of(array, volume));
        std::ostringstream into(std::ios::binary);
        Archive().write(into, grids, true, metadata_of(volume));
        std::string file = std::move(into).str();
        set_identifier(file);
        return file;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return failure(error.what());
    }
}

}  // namespace

}  // namespace cascade

extern "C" __attribute__((visibility("default"))) cascade::VdbEncoder* cascade_vdb_encoder(
    std::string_view version) {
    return version == cascade::version() ? &cascade::encode : nullptr;
}
