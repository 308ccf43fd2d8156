// The numbers in XML files of VTK.
//
// An array is written as decimal numbers or as Base64. It may also be stored after all other
// elements, as Base64 or raw bytes. Bytes may be compressed by zlib in blocks. The format is
// described in the VTK User's Guide (Kitware, "VTK XML Formats"). An array is never larger than its
// reader expects, even if the file gives another size.
#pragma once

#include "import/xml.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade::importing {

class VtkFile {
public:
    /// Reads the XML of the import's source. If it is not a file of VTK or has an unknown encoding,
    /// reports an error.
    static std::optional<VtkFile> read(Import& import, pugi::xml_document& document);

    pugi::xml_node root() const { return root_; }

    /// The `count` numbers of a <DataArray>. If the array has another count of numbers or cannot be
    /// read, reports an error at the array.
    std::optional<std::vector<double>> numbers(const pugi::xml_node& array,
                                               std::uint64_t count) const;
    /// All numbers of an array. If there are more than `most`, reports an error at the array.
    std::optional<std::vector<double>> all_numbers(const pugi::xml_node& array,
                                                   std::uint64_t most) const;

private:
    explicit VtkFile(Import& import) : import_(&import) {}

    std::optional<std::vector<double>> read_array(const pugi::xml_node& array, std::uint64_t least,
                                                  std::uint64_t most) const;
    std::optional<std::string> bytes_of(const pugi::xml_node& array, std::uint64_t most) const;
    std::optional<std::string> encoded(std::string_view text, bool is_base64, std::uint64_t most,
                                       const pugi::xml_node& array) const;
    std::optional<std::string> inflated(std::string_view text, bool is_base64, std::uint64_t most,
                                        const pugi::xml_node& array) const;
    std::nullopt_t fail(const pugi::xml_node& array, const std::string& why) const;
    std::uint64_t word(std::string_view bytes, std::size_t index) const;

    Import* import_;
    pugi::xml_node root_;
    std::size_t word_size_ = 4;  ///< The size in bytes of a number in a header.
    bool is_compressed_ = false;
    bool is_appended_base64_ = false;
    std::string_view appended_;  ///< The bytes after the mark `_`.
};

}  // namespace cascade::importing
