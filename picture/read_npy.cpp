// Reads .npy files.
#include "core/enough_memory.h"
#include "core/file.h"
#include "picture/npy.h"
#include "picture/npy_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

namespace cascade {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t most_elements = std::uint64_t{1} << 31;
static_assert(largest_npy_file >= most_elements * 8);

/// Converts the elements of a file to numbers. `swapped` means that the elements are big-endian.
using Convert = void (*)(std::string_view bytes, bool swapped, std::vector<double>& values);

/// Converts elements of type T. Each element is rounded only once, to Number.
template <typename T, typename Number>
void convert(std::string_view bytes, bool swapped, std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
        std::array<char, sizeof(T)> element;
        std::memcpy(element.data(), bytes.data() + k * sizeof(T), sizeof(T));
        if (swapped) std::reverse(element.begin(), element.end());
        values[k] = static_cast<Number>(std::bit_cast<T>(element));
    }
}

struct ElementType {
    std::string_view name;
    std::uint64_t size;
    Convert to_single;
    Convert to_double;
};

template <typename T>
constexpr ElementType element_type(std::string_view name) {
    return {name, sizeof(T), convert<T, float>, convert<T, double>};
}

constexpr std::array<ElementType, 11> element_types{{
    element_type<float>("f4"),
    element_type<double>("f8"),
    element_type<std::int8_t>("i1"),
    element_type<std::int16_t>("i2"),
    element_type<std::int32_t>("i4"),
    element_type<std::int64_t>("i8"),
    element_type<std::uint8_t>("u1"),
    element_type<std::uint16_t>("u2"),
    element_type<std::uint32_t>("u4"),
    element_type<std::uint64_t>("u8"),
    element_type<std::uint8_t>("b1"),
}};

/// Finds a type by its name without the byte order. Null if the type is unknown. Only a type of one
/// byte may lack a byte order ('|').
const ElementType* find_type(std::string_view type) {
    if (type.size() != 3 || std::string_view("<>=|").find(type[0]) == std::string_view::npos) {
        return nullptr;
    }
    for (const ElementType& candidate : element_types) {
        if (candidate.name != type.substr(1)) continue;
        return type[0] != '|' || candidate.size == 1 ? &candidate : nullptr;
    }
    return nullptr;
}

/// The name of a type, as it is in a file, made safe for a message.
std::string shown(std::string_view type) {
    std::string text(type.substr(0, 20));
    for (char& c : text) {
        if (c < ' ' || c > '~') c = '?';
    }
    return type.size() > 20 ? text + "..." : text;
}

tl::unexpected<Failure> wrong_type(const std::string& type) {
    const std::string hint = "save it as float32: numpy.save(file, array.astype('float32'))";
    if (type.empty()) return failure("its elements are records, not numbers", hint);
    if (type.find('O') != std::string::npos) {
        return failure("its elements are Python objects, not numbers", hint);
    }
    return failure(fmt::format("its elements are of type '{}', which cannot be read", shown(type)),
                   hint);
}

/// Makes an array with the dimensions of a header. Fails if it would have too many elements.
Result<NpyArray> array_of_shape(const NpyHeader& header) {
    const std::vector<std::uint64_t>& shape = header.shape;
    if (shape.empty()) return failure("it holds one number, not an array of rows and columns");
    if (shape.size() > 3) {
        return failure(fmt::format("its array has {} dimensions", shape.size()),
                       "a field has two, rows and columns, or three with slices in front");
    }
    if (header.fortran_order) {
        return failure("its array is in Fortran order",
                       "save it in C order: numpy.save(file, numpy.ascontiguousarray(array))");
    }
    const std::uint64_t slices = shape.size() == 3 ? shape[0] : 1;
    const std::uint64_t rows = shape.size() >= 2 ? shape[shape.size() - 2] : 1;
    const std::uint64_t columns = shape.back();
    if (slices == 0 || rows == 0 || columns == 0) return failure("its array has no elements");
    if (rows > most_elements / columns || slices > most_elements / (rows * columns)) {
        return failure(fmt::format("its array of {} elements is too large",
                                   fmt::join(shape, " × ")),
                       fmt::format("at most {} elements can be read", most_elements));
    }
    NpyArray array;
    array.slices = static_cast<std::int64_t>(slices);
    array.rows = static_cast<std::int64_t>(rows);
    array.columns = static_cast<std::int64_t>(columns);
    return array;
}

}  // namespace

Result<NpyArray> parse_npy(std::string_view bytes, Precision precision) {
    const Result<NpyHeader> header = parse_npy_header(bytes);
    if (!header) return tl::unexpected<Failure>(header.error());
    const ElementType* type = find_type(header->type);
    if (type == nullptr) return wrong_type(header->type);
    Result<NpyArray> array = array_of_shape(*header);
    if (!array) return array;
    const auto count = static_cast<std::uint64_t>(array->slices * array->rows * array->columns);
    const std::uint64_t wanted = count * type->size;
    const std::string_view data = bytes.substr(header->data_begin);
    if (data.size() != wanted) {
        return failure(fmt::format("it has {} bytes of elements instead of {}", data.size(),
                                   wanted),
                       data.size() < wanted ? "the file is cut off" : "");
    }
    const auto allocated = enough_memory_for([&]() -> Result<void> {
        array->values.resize(count);
        return {};
    });
    if (!allocated) return tl::unexpected(allocated.error());
    const Convert convert = precision == Precision::single ? type->to_single : type->to_double;
    convert(data, header->type[0] == '>', array->values);
    return array;
}

Result<NpyArray> read_npy(const std::filesystem::path& path, Precision precision) {
    const Result<std::string> bytes = read_linked_file(path, largest_npy_file);
    if (!bytes) return tl::unexpected<Failure>(bytes.error());
    Result<NpyArray> array = parse_npy(*bytes, precision);
    if (!array) {
        return failure(fmt::format("cannot read '{}': {}", path.string(), array.error().message),
                       array.error().hint);
    }
    return array;
}

bool fits(const NpyArray& array, const Grid& grid) {
    return array.slices == grid.depth && array.rows == grid.height && array.columns == grid.width;
}

Field to_field(const NpyArray& array, Precision precision) {
    Field field(PlaneLayout(Grid{array.columns, array.rows, {}, array.slices}), precision);
    field.visit([&](auto& plane) {
        using Number = std::remove_pointer_t<decltype(plane.row(0))>;
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            const auto values = array.values.begin() + row * array.columns;
            std::transform(values, values + array.columns, plane.row(row),
                           [](double value) { return static_cast<Number>(value); });
        }
    });
    return field;
}

}  // namespace cascade
