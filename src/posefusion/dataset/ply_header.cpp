#include "posefusion/dataset/ply_header.h"

#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace posefusion {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "PLY bytes are copied as they are");

template <class T>
double ReadAs(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// The scalar types of the PLY format (Turk 1994) by their old and new names.
const std::map<std::string, PlyScalarType>& ScalarTypes() {
  static const std::map<std::string, PlyScalarType> types = {
      {"char", {1, ReadAs<std::int8_t>}},     {"int8", {1, ReadAs<std::int8_t>}},
      {"uchar", {1, ReadAs<std::uint8_t>}},   {"uint8", {1, ReadAs<std::uint8_t>}},
      {"short", {2, ReadAs<std::int16_t>}},   {"int16", {2, ReadAs<std::int16_t>}},
      {"ushort", {2, ReadAs<std::uint16_t>}}, {"uint16", {2, ReadAs<std::uint16_t>}},
      {"int", {4, ReadAs<std::int32_t>}},     {"int32", {4, ReadAs<std::int32_t>}},
      {"uint", {4, ReadAs<std::uint32_t>}},   {"uint32", {4, ReadAs<std::uint32_t>}},
      {"float", {4, ReadAs<float>}},          {"float32", {4, ReadAs<float>}},
      {"double", {8, ReadAs<double>}},        {"float64", {8, ReadAs<double>}}};
  return types;
}

/// Collects the lines of a header.
class HeaderParser {
 public:
  explicit HeaderParser(const std::string& path) : path_(path) {}

  void ParseLine(const std::string& line) {
    std::istringstream words(line);
    std::string keyword;
    std::string first;
    std::string second;
    words >> keyword >> first >> second;
    if (keyword == "format" && first != "binary_little_endian") {
      Fail("PLY is " + first + ", not binary_little_endian");
    }
    if (keyword == "comment") header_.comments[first] = second;
    if (keyword == "element") StartElement(first, second);
    if (keyword == "property" && in_vertices_) AddProperty(first, second);
  }

  /// The header that took up so many of the file's bytes.
  PlyHeader Finish(std::size_t header_bytes, std::size_t file_bytes) {
    header_.header_bytes = header_bytes;
    if (header_.vertex_bytes == 0) Fail("PLY has no vertices");
    if ((file_bytes - header_bytes) / header_.vertex_bytes < header_.num_vertices) {
      Fail("PLY is truncated");
    }
    return header_;
  }

  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(path_ + ": " + message);
  }

 private:
  void StartElement(const std::string& name, const std::string& count) {
    in_vertices_ = name == "vertex";
    if (!in_vertices_ && header_.vertex_bytes == 0) Fail("PLY does not begin with vertices");
    if (in_vertices_ && !(std::istringstream(count) >> header_.num_vertices)) {
      Fail("PLY vertex count '" + count + "' is no number");
    }
  }

  void AddProperty(const std::string& type, const std::string& name) {
    const PlyScalarType* found = FindPlyScalarType(type);
    if (found == nullptr) Fail("PLY vertex property of unknown type " + type);
    header_.properties[name] = {header_.vertex_bytes, found->read};
    header_.vertex_bytes += found->size;
  }

  const std::string& path_;
  PlyHeader header_;
  bool in_vertices_ = false;
};

}  // namespace

const PlyScalarType* FindPlyScalarType(const std::string& name) {
  const auto found = ScalarTypes().find(name);
  return found == ScalarTypes().end() ? nullptr : &found->second;
}

PlyHeader ParsePlyHeader(const std::string& bytes, const std::string& path) {
  HeaderParser parser(path);
  std::size_t begin = 0;
  for (bool first = true;; first = false) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) parser.Fail(first ? "is no PLY file" : "PLY header has no end");
    std::string line = bytes.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    begin = end + 1;
    if (first && line != "ply") parser.Fail("is no PLY file");
    if (line == "end_header") return parser.Finish(begin, bytes.size());
    parser.ParseLine(line);
  }
}

}  // namespace posefusion
