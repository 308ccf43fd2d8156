// .npy files: files of NumPy are read, our files have the bytes of NumPy's, and other files are
// refused.
#include "picture/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <limits>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A file of version 1.0 with this dictionary and these elements.
std::string npy(const std::string& dictionary, const std::string& elements) {
    std::string file("\x93NUMPY\x01\x00", 8);
    file += static_cast<char>(dictionary.size() & 0xff);
    file += static_cast<char>(dictionary.size() >> 8);
    return file + dictionary + elements;
}

/// The dictionary of a C-ordered array, as NumPy writes it.
std::string dictionary(const std::string& type, const std::string& shape) {
    return "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
}

template <typename T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) {
        const auto part = std::bit_cast<std::array<char, sizeof(T)>>(value);
        bytes.append(part.data(), part.size());
    }
    return bytes;
}

std::vector<double> array_values(const std::string& file) {
    const Result<NpyArray> array = parse_npy(file);
    EXPECT_TRUE(array) << (array ? "" : array.error().message);
    return array ? array->values : std::vector<double>{};
}

std::string array_fault(const std::string& file) {
    const Result<NpyArray> array = parse_npy(file);
    return array ? "no fault" : array.error().message;
}

const std::string two_floats = bytes_of<float>({1, 2});

TEST(ParseNpy, AFileAsNumpyWritesIt) {
    // numpy.save(f, numpy.arange(6, dtype='<f4').reshape(2, 3) / 2), byte for byte.
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(0x75, ' ');
    header += '\n';
    const std::string elements("\0\0\0\0\0\0\0\x3f\0\0\x80\x3f\0\0\xc0\x3f\0\0\0\x40\0\0\x20\x40",
                               24);
    const Result<NpyArray> array =
        parse_npy(std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + elements);
    ASSERT_TRUE(array) << array.error().message;
    EXPECT_EQ(array->rows, 2);
    EXPECT_EQ(array->columns, 3);
    EXPECT_THAT(array->values, ElementsAre(0, 0.5F, 1, 1.5F, 2, 2.5F));
}

TEST(ParseNpy, OneDimensionIsOneRow) {
    const Result<NpyArray> array = parse_npy(npy(dictionary("<f4", "(2,)"), two_floats));
    ASSERT_TRUE(array) << array.error().message;
    EXPECT_EQ(array->rows, 1);
    EXPECT_EQ(array->columns, 2);
}

TEST(ParseNpy, NumbersOfAllTypes) {
    const auto read = [](const std::string& type, const std::string& elements) {
        return array_values(npy(dictionary(type, "(1, 2)"), elements));
    };
    EXPECT_THAT(read("<f4", bytes_of<float>({-0.5F, 3})), ElementsAre(-0.5F, 3));
    EXPECT_THAT(read("<f8", bytes_of<double>({0.1, -2})), ElementsAre(0.1F, -2));
    EXPECT_THAT(read("=f8", bytes_of<double>({0.1, -2})), ElementsAre(0.1F, -2));
    EXPECT_THAT(read("|i1", bytes_of<std::int8_t>({-128, 127})), ElementsAre(-128, 127));
    EXPECT_THAT(read("|u1", bytes_of<std::uint8_t>({200, 255})), ElementsAre(200, 255));
    EXPECT_THAT(read("|b1", bytes_of<std::uint8_t>({1, 0})), ElementsAre(1, 0));
    EXPECT_THAT(read("<i2", bytes_of<std::int16_t>({-300, 300})), ElementsAre(-300, 300));
    EXPECT_THAT(read("<u2", bytes_of<std::uint16_t>({65535, 1})), ElementsAre(65535, 1));
    EXPECT_THAT(read("<i4", bytes_of<std::int32_t>({-70000, 7})), ElementsAre(-70000, 7));
    EXPECT_THAT(read("<u4", bytes_of<std::uint32_t>({3000000000U, 7})), ElementsAre(3e9F, 7));
    EXPECT_THAT(read("<i8", bytes_of<std::int64_t>({-1, 1LL << 40})),
                ElementsAre(-1, 1099511627776.0F));
    EXPECT_THAT(read("<u8", bytes_of<std::uint64_t>({1ULL << 63, 5})),
                ElementsAre(9223372036854775808.0F, 5));
}

TEST(ParseNpy, BigEndianNumbers) {
    EXPECT_THAT(array_values(npy(dictionary(">f4", "(1, 1)"), std::string("\x3f\x80\0\0", 4))),
                ElementsAre(1));
    EXPECT_THAT(array_values(npy(dictionary(">i2", "(2,)"), std::string("\x01\x00\xff\xfe", 4))),
                ElementsAre(256, -2));
    EXPECT_THAT(array_values(npy(dictionary(">f8", "(1,)"), std::string("\xc0\0\0\0\0\0\0\0", 8))),
                ElementsAre(-2));
}

TEST(ParseNpy, HeadersInAnyFormThatPythonReads) {
    for (const char* text :
         {"{\"shape\":(1,2),\"descr\":\"<f4\",\"fortran_order\":False}",
          "  { 'fortran_order' : False , 'shape' : ( 1 , 2 , ) , 'descr' : '<f4' , }   \n",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (1L, 2L), }",
          "{'descr': '<f4',\n 'fortran_order': False,\n\t'shape': (1, 2)}\n"}) {
        EXPECT_THAT(array_values(npy(text, two_floats)), ElementsAre(1, 2)) << text;
    }
}

TEST(ParseNpy, VersionsTwoAndThree) {
    const std::string text = dictionary("<f4", "(1, 2)");
    for (const char version : {'\2', '\3'}) {
        std::string file = std::string("\x93NUMPY") + version + '\0';
        file += static_cast<char>(text.size());
        file += std::string(3, '\0') + text + two_floats;
        EXPECT_THAT(array_values(file), ElementsAre(1, 2));
    }
}

TEST(ParseNpy, OtherFilesAndVersions) {
    EXPECT_EQ(array_fault(""), "it is not a .npy file");
    EXPECT_EQ(array_fault("\x93NUMP"), "it is not a .npy file");
    EXPECT_EQ(array_fault("PK\x03\x04 an archive"), "it is not a .npy file");
    std::string file = npy(dictionary("<f4", "(1, 2)"), two_floats);
    file[6] = 4;
    EXPECT_EQ(array_fault(file), "its format version 4.0 is not known");
    file[6] = 1;
    file[7] = 9;
    EXPECT_EQ(array_fault(file), "its format version 1.9 is not known");
}

TEST(ParseNpy, FortranOrder) {
    const Result<NpyArray> array =
        parse_npy(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 2), }", two_floats));
    ASSERT_FALSE(array);
    EXPECT_EQ(array.error().message, "its array is in Fortran order");
    EXPECT_THAT(array.error().hint, HasSubstr("ascontiguousarray"));
}

TEST(ParseNpy, DimensionsThatNoFieldHas) {
    EXPECT_EQ(array_fault(npy(dictionary("<f4", "(1, 1, 2, 1)"), two_floats)),
              "its array has 4 dimensions");
    EXPECT_EQ(array_fault(npy(dictionary("<f4", "()"), bytes_of<float>({1}))),
              "it holds one number, not an array of rows and columns");
    EXPECT_EQ(array_fault(npy(dictionary("<f4", "(0, 2)"), "")), "its array has no elements");
    EXPECT_EQ(array_fault(npy(dictionary("<f4", "(0,)"), "")), "its array has no elements");
}

TEST(ParseNpy, TypesThatAreNoNumbers) {
    const auto fault = [](const std::string& type) {
        return array_fault(npy(dictionary(type, "(1, 2)"), two_floats));
    };
    EXPECT_EQ(fault("|O"), "its elements are Python objects, not numbers");
    EXPECT_EQ(fault("<c8"), "its elements are of type '<c8', which cannot be read");
    EXPECT_EQ(fault("<f2"), "its elements are of type '<f2', which cannot be read");
    EXPECT_EQ(fault("<U1"), "its elements are of type '<U1', which cannot be read");
    EXPECT_EQ(fault("|f4"), "its elements are of type '|f4', which cannot be read");
    EXPECT_EQ(fault("f4"), "its elements are of type 'f4', which cannot be read");
    EXPECT_EQ(fault("\x1b[31m"), "its elements are of type '?[31m', which cannot be read");
    EXPECT_EQ(array_fault(
                  npy("{'descr': [('a', '<f4'), ('b]', '<f4', (2,))], 'fortran_order': False,"
                      " 'shape': (1,), }",
                      two_floats)),
              "its elements are records, not numbers");
}

TEST(ParseNpy, MissingAndSurplusElements) {
    const std::string text = dictionary("<f4", "(1, 2)");
    EXPECT_EQ(array_fault(npy(text, two_floats.substr(0, 7))),
              "it has 7 bytes of elements instead of 8");
    EXPECT_EQ(parse_npy(npy(text, "")).error().hint, "the file is cut off");
    EXPECT_EQ(array_fault(npy(text, two_floats + "x")), "it has 9 bytes of elements instead of 8");
}

TEST(ParseNpy, SizesThatOverflow) {
    const auto fault = [](const std::string& shape) {
        return array_fault(npy(dictionary("<f8", shape), two_floats));
    };
    EXPECT_EQ(fault("(4294967296, 4294967296)"),
              "its array of 4294967296 × 4294967296 elements is too large");
    EXPECT_THAT(fault("(1, 18446744073709551615)"), HasSubstr("too large"));
    EXPECT_THAT(fault("(2147483649,)"), HasSubstr("too large"));
    EXPECT_EQ(fault("(18446744073709551616, 1)"), "its header is malformed");
    EXPECT_EQ(fault("(2147483648, 1)"), "it has 8 bytes of elements instead of 17179869184");
}

TEST(ParseNpy, MalformedHeaders) {
    for (const char* text :
         {"", "{", "{}", "nonsense", "{'descr': '<f4', 'fortran_order': False}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), 'more': 1}",
          "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (1, 2)}",
          "{'descr': '<f4', 'fortran_order': 0, 'shape': (1, 2)}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (1 2)}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (2)}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (-1, 2)}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': [1, 2]}",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2)} x",
          "{'descr': '<f4' 'fortran_order': False, 'shape': (1, 2)}",
          "{'descr': '<f4, 'fortran_order': False, 'shape': (1, 2)}",
          "{'descr': [('a', '<f4'), 'fortran_order': False, 'shape': (1, 2)}"}) {
        EXPECT_EQ(array_fault(npy(text, two_floats)), "its header is malformed") << text;
    }
}

TEST(ParseNpy, HeadersThatEndTooEarlyOrNeverEnd) {
    const std::string file = npy(dictionary("<f4", "(1, 2)"), "");
    for (std::size_t size = 6; size < file.size(); ++size) {
        EXPECT_EQ(array_fault(file.substr(0, size)), "it ends within the header") << size;
    }
    const std::string huge("\x93NUMPY\x02\x00\xff\xff\xff\xff{'descr': '<f4'", 27);
    EXPECT_EQ(array_fault(huge), "its header of 4294967295 bytes is too long");
}

Field three_by_two() {
    Field field(PlaneLayout(Grid{3, 2}));
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 3; ++i) field.at(i, j) = static_cast<float>(3 * j + i) / 4;
    }
    return field;
}

TEST(EncodeNpy, TheBytesOfNumpy) {
    const std::string file = encode_npy(three_by_two());
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(0x75, ' ');
    EXPECT_EQ(file.substr(0, 128), std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n");
    EXPECT_EQ(file.substr(128), bytes_of<float>({0, 0.25F, 0.5F, 0.75F, 1, 1.25F}));
}

TEST(EncodeNpy, ElementsStartAtMultiplesOf64) {
    for (const std::int64_t width : {1, 9, 10, 99, 100, 1000, 12345, 100000}) {
        const std::string file = encode_npy(Field(PlaneLayout(Grid{width, 1})));
        EXPECT_EQ((file.size() - static_cast<std::size_t>(width) * 4) % 64, 0U) << width;
        EXPECT_EQ(file[file.size() - static_cast<std::size_t>(width) * 4 - 1], '\n');
    }
}

TEST(EncodeNpy, EveryValueKeepsItsBitsAndEveryNanIsOne) {
    constexpr float denormal = std::numeric_limits<float>::denorm_min();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Field field(PlaneLayout(Grid{6, 1}));
    field.at(0, 0) = -0.0F;
    field.at(1, 0) = -denormal;
    field.at(2, 0) = infinity;
    field.at(3, 0) = std::bit_cast<float>(0xffc12345U);
    field.at(4, 0) = std::bit_cast<float>(0x7fc00001U);
    field.at(5, 0) = 0.1F;
    const std::string file = encode_npy(field);
    EXPECT_EQ(file.substr(file.size() - 24),
              bytes_of<std::uint32_t>(
                  {0x80000000U, 0x80000001U, 0x7f800000U, 0x7fc00000U, 0x7fc00000U, 0x3dcccccdU}));
}

TEST(NpyFile, WrittenAndReadAgain) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                         ("cascade_npy_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / "large.b.npy";
    ASSERT_TRUE(write_npy(path, three_by_two()));
    const Result<NpyArray> array = read_npy(path);
    ASSERT_TRUE(array) << array.error().message;
    EXPECT_EQ(array->rows, 2);
    EXPECT_EQ(array->columns, 3);
    EXPECT_THAT(array->values, ElementsAre(0, 0.25F, 0.5F, 0.75F, 1, 1.25F));

    std::ofstream(path) << "no array";
    EXPECT_THAT(read_npy(path).error().message, HasSubstr("b.npy': it is not a .npy file"));
    EXPECT_THAT(read_npy(folder / "none.npy").error().message, HasSubstr("none.npy"));
    EXPECT_FALSE(read_npy(folder));
    EXPECT_FALSE(write_npy(folder / "no" / "b.npy", three_by_two()));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cascade
