// The key consists of two hashes of the mesh and the options. All data read from a file are
// validated before use.
#include "surface/cell_file.h"

#include "core/file.h"
#include "core/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cascade {

namespace {

constexpr std::string_view magic = "CASCELLS";
constexpr std::uint32_t byte_order_mark = 0x01020304;

/// The first 64 bytes of a file. The structure has no padding.
struct Header {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t byte_order = 0;
    std::array<std::uint64_t, 2> key{};
    std::uint64_t cells = 0;
    std::uint64_t edges = 0;
    double bare_area = 0;
    std::uint64_t reserved = 0;
};
static_assert(sizeof(Header) == 64);

constexpr std::uint64_t bytes_per_cell = 4 + 3 * 8 + 8 + 8;
constexpr std::uint64_t bytes_per_edge = 4 + 8 + 8;
// No list may have more entries, so that sums of sizes do not overflow.
constexpr std::uint64_t most_entries = std::uint64_t{1} << 40;

template <typename T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads values from the beginning of a text, which must be long enough.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
    template <typename T>
    T take() {
        T value;
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
        return value;
    }

private:
    std::string_view bytes_;
};

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, double> ||
                  std::is_same_v<T, Vector3d>);
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Two hashes of a sequence of texts.
class TwoHashes {
public:
    void add(std::string_view bytes) {
        for (std::uint64_t& word : key_.words) word = fnv1a(bytes, word);
    }
    template <typename T>
    void add_values(const std::vector<T>& values) {
        add_value(std::uint64_t{values.size()});
        add(bytes_of(values));
    }
    template <typename T>
    void add_value(T value) {
        add({reinterpret_cast<const char*>(&value), sizeof value});
    }
    CellKey key() const { return key_; }

private:
    CellKey key_{{0xcbf29ce484222325ULL, 0x9ae16a3b2f90404fULL}};
};

std::uint64_t size_of(const Header& header) {
    return sizeof header + header.cells * bytes_per_cell + header.edges * bytes_per_edge + 8;
}

Result<Header> parse_header(std::string_view bytes, const CellKey& key) {
    Header header;
    std::memcpy(&header, bytes.data(), std::min(bytes.size(), sizeof header));
    if (bytes.size() < sizeof header ||
        std::string_view(header.magic.data(), header.magic.size()) != magic) {
        return failure("is not a file of cells");
    }
    if (header.byte_order != byte_order_mark) {
        return failure("comes from a machine with another byte order");
    }
    if (header.version != cell_file_version) {
        return failure(fmt::format("is of version {}, not {}", header.version, cell_file_version));
    }
    if (header.key != key.words) {
        return failure("holds cells of another surface, or cells that were made in another way");
    }
    if (header.cells > most_entries || header.edges > most_entries) {
        return failure("is damaged: it cannot be as large as it says");
    }
    return header;
}

bool is_positive(double number) { return std::isfinite(number) && number > 0; }

bool is_sound(const SurfacePlace& place, const SurfaceMesh& mesh) {
    if (place.triangle >= mesh.triangles.size()) return false;
    return std::all_of(place.weights.begin(), place.weights.end(),
                       [](double weight) { return weight >= 0 && weight <= 1; });
}

/// Whether a cell's Voronoi edges are sorted by neighbour, and each also appears in its neighbour's
/// list.
bool are_sound(const SurfaceCells& cells, std::uint32_t cell) {
    const auto edges = cells.edges_of(cell);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const VoronoiEdge& edge = edges[k];
        if (edge.neighbour >= cells.places.size() || edge.neighbour == cell) return false;
        if (k > 0 && edge.neighbour <= edges[k - 1].neighbour) return false;
        if (!is_positive(edge.length) || !is_positive(edge.distance)) return false;
        const auto others = cells.edges_of(edge.neighbour);
        if (std::none_of(others.begin(), others.end(), [&](const VoronoiEdge& back) {
                return back.neighbour == cell && back.length == edge.length &&
                       back.distance == edge.distance;
            })) {
            return false;
        }
    }
    return true;
}

bool are_sound(const SurfaceCells& cells, const SurfaceMesh& mesh) {
    if (!std::is_sorted(cells.ends.begin(), cells.ends.end())) return false;
    if ((cells.ends.empty() ? 0 : cells.ends.back()) != cells.edges.size()) return false;
    if (!(cells.bare_area >= 0)) return false;
    for (std::uint32_t cell = 0; cell < cells.places.size(); ++cell) {
        if (!is_sound(cells.places[cell], mesh) || !(cells.areas[cell] >= 0) ||
            !std::isfinite(cells.areas[cell]) || !are_sound(cells, cell)) {
            return false;
        }
    }
    return true;
}

SurfaceCells taken_from(Bytes bytes, const Header& header) {
    SurfaceCells cells;
    cells.bare_area = header.bare_area;
    cells.places.reserve(header.cells);
    cells.areas.reserve(header.cells);
    cells.ends.reserve(header.cells);
    cells.edges.reserve(header.edges);
    for (std::uint64_t k = 0; k < header.cells; ++k) {
        SurfacePlace place;
        place.triangle = bytes.take<std::uint32_t>();
        for (double& weight : place.weights) weight = bytes.take<double>();
        cells.places.push_back(place);
        cells.areas.push_back(bytes.take<double>());
        cells.ends.push_back(bytes.take<std::uint64_t>());
    }
    for (std::uint64_t k = 0; k < header.edges; ++k) {
        VoronoiEdge edge;
        edge.neighbour = bytes.take<std::uint32_t>();
        edge.length = bytes.take<double>();
        edge.distance = bytes.take<double>();
        cells.edges.push_back(edge);
    }
    return cells;
}

}  // namespace

std::string CellKey::text() const { return fmt::format("{:016x}{:016x}", words[0], words[1]); }

CellKey key_of(const SurfaceMesh& mesh, const CellOptions& options) {
    TwoHashes hashes;
    hashes.add_value(cell_file_version);
    hashes.add_values(mesh.points);
    hashes.add_values(mesh.triangles);
    hashes.add_values(mesh.across);
    hashes.add_value(options.kind);
    if (options.kind == CellKind::faces) hashes.add_values(mesh.faces);
    if (options.kind != CellKind::places) return hashes.key();
    hashes.add_value(options.count);
    hashes.add_value(options.seed);
    hashes.add_value(options.rounds);
    hashes.add_value(options.anisotropy != nullptr);
    if (options.anisotropy) {
        hashes.add_values(options.anisotropy->direction);
        hashes.add_values(options.anisotropy->ratio);
    }
    return hashes.key();
}

std::string print_cells(const SurfaceCells& cells, const CellKey& key) {
    Header header;
    std::copy(magic.begin(), magic.end(), header.magic.begin());
    header.version = cell_file_version;
    header.byte_order = byte_order_mark;
    header.key = key.words;
    header.cells = cells.places.size();
    header.edges = cells.edges.size();
    header.bare_area = cells.bare_area;
    std::string bytes;
    bytes.reserve(size_of(header));
    append(bytes, header);
    for (std::size_t k = 0; k < cells.places.size(); ++k) {
        append(bytes, cells.places[k].triangle);
        append(bytes, cells.places[k].weights);
        append(bytes, cells.areas[k]);
        append(bytes, std::uint64_t{cells.ends[k]});
    }
    for (const VoronoiEdge& edge : cells.edges) {
        append(bytes, edge.neighbour);
        append(bytes, edge.length);
        append(bytes, edge.distance);
    }
    append(bytes, fnv1a(bytes));
    return bytes;
}

Result<SurfaceCells> parse_cells(std::string_view bytes, const SurfaceMesh& mesh,
                                 const CellKey& key) {
    const Result<Header> header = parse_header(bytes, key);
    if (!header) return tl::unexpected(header.error());
    if (bytes.size() != size_of(*header)) {
        return failure("is damaged: its size is not what it says");
    }
    const std::string_view content = bytes.substr(0, bytes.size() - 8);
    if (Bytes(bytes.substr(content.size())).take<std::uint64_t>() != fnv1a(content)) {
        return failure("is damaged: its checksum is wrong");
    }
    SurfaceCells cells = taken_from(Bytes(content.substr(sizeof(Header))), *header);
    if (!are_sound(cells, mesh)) return failure("is damaged: its cells do not fit the surface");
    return cells;
}

Result<void> write_cells(const std::filesystem::path& path, const SurfaceCells& cells,
                         const CellKey& key) {
    return write_file(path, print_cells(cells, key));
}

Result<SurfaceCells> read_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                                const CellKey& key) {
    const auto fails = [&](const Failure& why) {
        return failure(fmt::format("'{}' {}", path.string(), why.message));
    };
    // The file may have any size, and may be replaced while it is read.
    if (!size_of_file(path)) return fails({"is not there", ""});
    const Result<Header> header = parse_header(first_bytes(path, sizeof(Header)), key);
    if (!header) return fails(header.error());
    const Result<std::string> bytes = read_file(path, size_of(*header));
    if (!bytes) return tl::unexpected(bytes.error());
    Result<SurfaceCells> cells = parse_cells(*bytes, mesh, key);
    if (cells) return cells;
    return fails(cells.error());
}

Result<KeptCells> kept_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                             const CellOptions& options, Team& team,
                             const std::atomic<bool>& cancel) {
    const CellKey key = key_of(mesh, options);
    if (Result<SurfaceCells> cells = read_cells(path, mesh, key)) {
        return KeptCells{*std::move(cells), true, ""};
    }
    Result<SurfaceCells> cells = make_cells(mesh, options, team, cancel);
    if (!cells) return tl::unexpected(cells.error());
    KeptCells kept{*std::move(cells), false, ""};
    if (cancel) return kept;
    if (const Result<void> written = write_cells(path, kept.cells, key); !written) {
        kept.not_kept = written.error().message;
    }
    return kept;
}

}  // namespace cascade
