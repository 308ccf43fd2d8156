// Decodes the arrays of XML files of VTK. The reader limits their sizes.
#include "import/vtk_arrays.h"

#include "core/base64.h"
#include "core/decimal.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace cascade::importing {

namespace {

struct VtkType {
    std::string_view name;
    std::size_t size;
    double (*value)(const char* bytes);
};
template <typename Number>
double vtk_value(const char* bytes) {
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
}
constexpr VtkType vtk_types[] = {
    {"Float32", 4, vtk_value<float>},      {"Float64", 8, vtk_value<double>},
    {"Int8", 1, vtk_value<std::int8_t>},   {"UInt8", 1, vtk_value<std::uint8_t>},
    {"Int16", 2, vtk_value<std::int16_t>}, {"UInt16", 2, vtk_value<std::uint16_t>},
    {"Int32", 4, vtk_value<std::int32_t>}, {"UInt32", 4, vtk_value<std::uint32_t>},
    {"Int64", 8, vtk_value<std::int64_t>}, {"UInt64", 8, vtk_value<std::uint64_t>},
};

const VtkType* vtk_type(std::string_view name) {
    for (const VtkType& type : vtk_types) {
        if (type.name == name) return &type;
    }
    return nullptr;
}

bool is_blank_letter(char letter) { return letter == ' ' || (letter >= '\t' && letter <= '\r'); }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank_letter(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank_letter(text.back())) text.remove_suffix(1);
    return text;
}

/// The number of letters of Base64 that encode `bytes` bytes.
std::uint64_t letters_for(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

/// Decodes the first `bytes` bytes of a text of Base64 that encodes at least that many.
std::optional<std::string> first_of_base64(std::string_view text, std::uint64_t bytes) {
    const std::uint64_t letters = letters_for(bytes);
    if (letters > text.size()) return std::nullopt;
    auto decoded = from_base64(text.substr(0, letters));
    if (!decoded || decoded->size() < bytes) return std::nullopt;
    decoded->resize(bytes);
    return decoded;
}

}  // namespace

std::optional<VtkFile> VtkFile::read(Import& import, pugi::xml_document& document) {
    const std::string_view text = import.bytes();
    const std::size_t appended = text.find("<AppendedData");
    // Raw bytes are not XML, so the document ends before them.
    const bool is_read = read_xml(import, appended, document);
    if (!is_read) return std::nullopt;
    VtkFile file(import);
    file.root_ = document.child("VTKFile");
    const auto refuse = [&](const std::string& why) {
        import.diagnostics.error(place_of(import, file.root_), why);
        return std::nullopt;
    };
    if (!file.root_) return refuse("this is not an XML file of VTK");
    if (std::string_view(file.root_.attribute("byte_order").as_string("LittleEndian")) !=
        "LittleEndian") {
        return refuse("only byte_order=\"LittleEndian\" can be read");
    }
    const std::string_view words = file.root_.attribute("header_type").as_string("UInt32");
    if (words != "UInt32" && words != "UInt64") return refuse("the header_type is unknown");
    file.word_size_ = words == "UInt64" ? 8 : 4;
    const std::string_view compressor = file.root_.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
        return refuse("only the compressor vtkZLibDataCompressor can be read");
    }
    file.is_compressed_ = !compressor.empty();
    if (appended == std::string_view::npos) return file;
    const std::size_t begin = text.find('>', appended);
    const std::size_t mark = begin == std::string_view::npos ? begin : text.find('_', begin);
    if (mark == std::string_view::npos) return refuse("the appended data has no mark '_'");
    file.is_appended_base64_ =
        text.substr(appended, begin - appended).find("base64") != std::string_view::npos;
    file.appended_ = text.substr(mark + 1);
    return file;
}

std::nullopt_t VtkFile::fail(const pugi::xml_node& array, const std::string& why) const {
    const std::string name = plain_line(array.attribute("Name").value());
    import_->diagnostics.error(place_of(*import_, array),
                               fmt::format("the array '{}' {}", name, why));
    return std::nullopt;
}

std::uint64_t VtkFile::word(std::string_view bytes, std::size_t index) const {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + index * word_size_, word_size_);
    return value;
}

std::optional<std::vector<double>> VtkFile::numbers(const pugi::xml_node& array,
                                                    std::uint64_t count) const {
    return read_array(array, count, count);
}

std::optional<std::vector<double>> VtkFile::all_numbers(const pugi::xml_node& array,
                                                        std::uint64_t most) const {
    return read_array(array, 0, most);
}

std::optional<std::vector<double>> VtkFile::read_array(const pugi::xml_node& array,
                                                       std::uint64_t least,
                                                       std::uint64_t most) const {
    std::vector<double> values;
    const auto wrong_count = [&] {
        return fail(array, least == most ? fmt::format("does not have {} numbers", most)
                                         : fmt::format("has more than {} numbers", most));
    };
    if (std::string_view(array.attribute("format").value()) == "ascii") {
        std::string_view text = without_blanks(array.child_value());
        while (!text.empty()) {
            double value = 0;
            const auto result = from_decimal(text.data(), text.data() + text.size(), value);
            if (result.ec != std::errc()) return fail(array, "has a word that is not a number");
            if (values.size() == most) return wrong_count();
            values.push_back(value);
            text = without_blanks(text.substr(static_cast<std::size_t>(result.ptr - text.data())));
        }
    } else {
        const VtkType* const type = vtk_type(array.attribute("type").value());
        if (type == nullptr) return fail(array, "has an unknown type");
        const auto bytes = bytes_of(array, most * type->size);
        if (!bytes) return std::nullopt;
        if (bytes->size() % type->size != 0) return wrong_count();
        values.reserve(bytes->size() / type->size);
        for (std::size_t at = 0; at < bytes->size(); at += type->size) {
            values.push_back(type->value(bytes->data() + at));
        }
    }
    if (values.size() < least || values.size() > most) return wrong_count();
    return values;
}

std::optional<std::string> VtkFile::bytes_of(const pugi::xml_node& array,
                                             std::uint64_t most) const {
    const std::string_view format = array.attribute("format").value();
    if (format == "binary") {
        return encoded(without_blanks(array.child_value()), true, most, array);
    }
    if (format != "appended") return fail(array, "has an unknown format");
    const auto offset = plain_number(array.attribute("offset").value());
    if (!offset || *offset < 0 || *offset > static_cast<double>(appended_.size())) {
        return fail(array, "begins beyond the end of the file");
    }
    return encoded(appended_.substr(static_cast<std::size_t>(*offset)), is_appended_base64_, most,
                   array);
}

std::optional<std::string> VtkFile::encoded(std::string_view text, bool is_base64,
                                            std::uint64_t most, const pugi::xml_node& array) const {
    if (is_compressed_) return inflated(text, is_base64, most, array);
    const auto head = is_base64 ? first_of_base64(text, word_size_)
                                : std::optional(std::string(text.substr(0, word_size_)));
    if (!head || head->size() < word_size_) return fail(array, "ends too early");
    const std::uint64_t size = word(*head, 0);
    if (size > most) return fail(array, "is larger than the domain");
    if (is_base64) {
        const auto all = first_of_base64(text, word_size_ + size);
        if (!all) return fail(array, "is not valid Base64, or ends too early");
        return all->substr(word_size_);
    }
    if (text.size() < word_size_ + size) return fail(array, "ends too early");
    return std::string(text.substr(word_size_, size));
}

std::optional<std::string> VtkFile::inflated(std::string_view text, bool is_base64,
                                             std::uint64_t most,
                                             const pugi::xml_node& array) const {
    // Reads the header: the number of blocks, their size, the size of a shorter last block or 0,
    // and the compressed size of each block.
    const auto first = [&](std::uint64_t count) -> std::optional<std::string> {
        if (is_base64) return first_of_base64(text, count * word_size_);
        if (text.size() < count * word_size_) return std::nullopt;
        return std::string(text.substr(0, count * word_size_));
    };
    const auto ends = [&] { return fail(array, "is not valid Base64, or ends too early"); };
    const auto sizes = first(3);
    if (!sizes) return ends();
    const std::uint64_t blocks = word(*sizes, 0), block = word(*sizes, 1), last = word(*sizes, 2);
    if (blocks == 0) return std::string();
    const bool is_too_large = blocks > most || block > (std::uint64_t{1} << 30) || last > block ||
                              (blocks - 1) * block + (last > 0 ? last : block) > most;
    if (is_too_large) return fail(array, "is larger than the domain");
    const auto head = first(3 + blocks);
    if (!head) return ends();
    std::uint64_t compressed = 0;
    for (std::uint64_t k = 0; k < blocks; ++k) {
        const std::uint64_t size = word(*head, 3 + k);
        if (size > text.size()) return ends();
        compressed += size;
    }
    const std::uint64_t head_size = (3 + blocks) * word_size_;
    text.remove_prefix(is_base64 ? letters_for(head_size) : head_size);
    std::optional<std::string> bytes;
    if (is_base64) bytes = first_of_base64(text, compressed);
    if (!is_base64 && compressed <= text.size()) bytes = text.substr(0, compressed);
    if (!bytes) return ends();

    const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    std::string result((blocks - 1) * block + (last > 0 ? last : block), '\0');
    std::uint64_t from = 0;
    for (std::uint64_t k = 0; k < blocks; ++k) {
        const std::uint64_t size = word(*head, 3 + k);
        const std::uint64_t room = k + 1 < blocks || last == 0 ? block : last;
        // Fails unless the block has exactly the size that the header gives.
        const bool is_inflated = libdeflate_zlib_decompress(inflater.get(), bytes->data() + from,
                                                            size, result.data() + k * block, room,
                                                            nullptr) == LIBDEFLATE_SUCCESS;
        if (!is_inflated) return fail(array, "is not compressed by zlib as its header says");
        from += size;
    }
    return result;
}

}  // namespace cascade::importing
