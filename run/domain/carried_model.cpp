// The bytes contain lists of numbers and the cells. The length of a list precedes its numbers. The
// cells have the format of files of cells.
#include "run/domain/carried_model.h"

#include "surface/cell_file.h"

#include <cstring>
#include <type_traits>

namespace cascade {
namespace {

constexpr std::string_view model_magic = "CASMODEL";

class ModelPrinter {
public:
    template <typename T>
    void list(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        number(values.size());
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    void text(std::string_view text) {
        number(text.size());
        bytes_ += text;
    }
    void number(std::uint64_t number) {
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    std::string bytes() && { return std::move(bytes_); }

private:
    std::string bytes_{model_magic};
};

/// Reads the bytes. Fails as soon as a length exceeds the rest of the bytes.
class ModelReader {
public:
    explicit ModelReader(std::string_view bytes) : rest_(bytes) {
        is_sound_ = take(model_magic.size()) == model_magic;
    }
    template <typename T>
    std::vector<T> list() {
        std::vector<T> values;
        const std::uint64_t count = number();
        if (count > rest_.size() / sizeof(T)) is_sound_ = false;
        if (!is_sound_) return values;
        values.resize(static_cast<std::size_t>(count));
        const std::string_view bytes = take(count * sizeof(T));
        if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    std::string text() { return std::string(take(number())); }
    std::uint64_t number() {
        std::uint64_t number = 0;
        const std::string_view bytes = take(sizeof number);
        if (is_sound_) std::memcpy(&number, bytes.data(), sizeof number);
        return number;
    }
    std::string_view rest() const { return rest_; }
    bool is_sound() const { return is_sound_; }

private:
    std::string_view take(std::uint64_t size) {
        is_sound_ = is_sound_ && size <= rest_.size();
        if (!is_sound_) return {};
        const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view rest_;
    bool is_sound_ = true;
};

/// Whether all corners refer to existing points, and each link from an edge to a neighbouring edge
/// has a link back.
bool is_sound(const SurfaceMesh& mesh) {
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const TriangleEdge& edge = mesh.across[k][corner];
            if (mesh.triangles[k][corner] >= mesh.points.size()) return false;
            if (!edge.exists()) continue;
            if (edge.triangle >= mesh.triangles.size() || edge.edge > 2) return false;
            if (mesh.across[edge.triangle][edge.edge] != TriangleEdge{k, corner}) return false;
        }
    }
    return true;
}

}  // namespace

std::string print_carried_model(const ModelCells& model) {
    ModelPrinter printer;
    const SurfaceMesh& mesh = model.mesh;
    printer.list(mesh.points);
    printer.list(mesh.triangles);
    printer.list(mesh.across);
    printer.list(mesh.texture);
    printer.list(mesh.faces);
    printer.number(mesh.attributes.size());
    for (const PointAttribute& attribute : mesh.attributes) {
        printer.text(attribute.name);
        printer.list(attribute.values);
    }
    printer.number(model.repairs.size());
    for (const std::string& repair : model.repairs) printer.text(repair);
    return std::move(printer).bytes() + print_cells(model.spread().cells, {});
}

Result<CarriedModel> parse_carried_model(std::string_view bytes) {
    const auto damaged = [] { return failure("the model that the page carries is damaged"); };
    ModelReader reader(bytes);
    CarriedModel model;
    SurfaceMesh& mesh = model.mesh;
    mesh.points = reader.list<Vector3d>();
    mesh.triangles = reader.list<std::array<std::uint32_t, 3>>();
    mesh.across = reader.list<std::array<TriangleEdge, 3>>();
    mesh.texture = reader.list<std::array<TexturePlace, 3>>();
    mesh.faces = reader.list<std::uint32_t>();
    for (std::uint64_t left = reader.number(); reader.is_sound() && left > 0; --left) {
        std::string name = reader.text();
        mesh.attributes.push_back({std::move(name), reader.list<float>()});
        if (mesh.attributes.back().values.size() != mesh.points.size()) return damaged();
    }
    for (std::uint64_t left = reader.number(); reader.is_sound() && left > 0; --left) {
        model.repairs.push_back(reader.text());
    }
    const auto is_list_of = [&](std::size_t size) {
        return size == 0 || size == mesh.triangles.size();
    };
    if (!reader.is_sound() || mesh.across.size() != mesh.triangles.size() ||
        !is_list_of(mesh.texture.size()) || !is_list_of(mesh.faces.size())) {
        return damaged();
    }
    if (!is_sound(mesh)) return damaged();
    auto cells = parse_cells(reader.rest(), mesh, {});
    if (!cells || cells->places.empty()) return damaged();
    model.cells = *std::move(cells);
    return model;
}

}  // namespace cascade
