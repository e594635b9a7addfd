#include "posefusion/dataset/mesh_file.h"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/ply_header.h"

namespace posefusion {
namespace {

constexpr std::size_t kBytesPerTriangle = 13;
constexpr std::uint8_t kCorners = 3;

[[noreturn]] void ThrowFor(const std::string& path, const std::string& message) {
  throw std::runtime_error(path + ": " + message);
}

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// A value or a list of values that each item of an element has.
struct Property {
  std::string name;
  const PlyScalarType* count_type = nullptr;  ///< null for a single value
  const PlyScalarType* value_type = nullptr;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool is_ascii = false;
  std::vector<Element> elements;
};

const PlyScalarType* ScalarType(const std::string& name, const std::string& path) {
  const PlyScalarType* type = FindPlyScalarType(name);
  if (type == nullptr) ThrowFor(path, "PLY property of unknown type '" + name + "'");
  return type;
}

void ParseHeaderLine(const std::string& line, const std::string& path, Header& header) {
  std::istringstream words(line);
  std::string keyword;
  std::string first;
  std::string second;
  words >> keyword >> first >> second;
  if (keyword == "format") {
    header.is_ascii = first == "ascii";
    if (!header.is_ascii && first != "binary_little_endian") {
      ThrowFor(path, "PLY is " + first + ", neither ascii nor binary_little_endian");
    }
  } else if (keyword == "element") {
    header.elements.push_back({first, 0, {}});
    if (!(std::istringstream(second) >> header.elements.back().count)) {
      ThrowFor(path, "PLY count '" + second + "' is no number");
    }
  } else if (keyword == "property" && header.elements.empty()) {
    ThrowFor(path, "PLY property without element");
  } else if (keyword == "property" && first == "list") {
    std::string value_type;
    std::string name;
    words >> value_type >> name;
    header.elements.back().properties.push_back(
        {name, ScalarType(second, path), ScalarType(value_type, path)});
  } else if (keyword == "property") {
    header.elements.back().properties.push_back({second, nullptr, ScalarType(first, path)});
  }
}

/// Reads the header's lines from the start of `bytes`; `end` becomes the place of the first item.
Header ParseHeader(const std::string& bytes, const std::string& path, std::size_t& end) {
  Header header;
  std::size_t begin = 0;
  for (bool first = true;; first = false) {
    const std::size_t line_end = bytes.find('\n', begin);
    if (line_end == std::string::npos) ThrowFor(path, "is no complete PLY file");
    std::string line = bytes.substr(begin, line_end - begin);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    begin = line_end + 1;
    if (first && line != "ply") ThrowFor(path, "is no PLY file");
    if (line == "end_header") break;
    ParseHeaderLine(line, path, header);
  }
  end = begin;
  return header;
}

/// Gives the numbers behind the header one after the other.
class NumberReader {
 public:
  NumberReader(const std::string& bytes, std::size_t begin, bool is_ascii, const std::string& path)
      : bytes_(bytes), next_(begin), is_ascii_(is_ascii), path_(path) {}

  double Next(const PlyScalarType& type) {
    if (is_ascii_) return NextWord();
    if (bytes_.size() - next_ < type.size) ThrowFor(path_, "PLY is truncated");
    const double value = type.read(bytes_.data() + next_);
    next_ += type.size;
    return value;
  }

  /// The values of a property of the next item.
  void Next(const Property& property, std::vector<double>& values) {
    const double count = property.count_type == nullptr ? 1 : Next(*property.count_type);
    values.clear();
    for (double i = 0; i < count; ++i) values.push_back(Next(*property.value_type));
  }

 private:
  double NextWord() {
    char* word_end = nullptr;
    const char* word = bytes_.c_str() + next_;
    const double value = std::strtod(word, &word_end);
    if (word_end == word) ThrowFor(path_, "PLY is truncated or holds something else than numbers");
    next_ += static_cast<std::size_t>(word_end - word);
    return value;
  }

  const std::string& bytes_;
  std::size_t next_;
  bool is_ascii_;
  const std::string& path_;
};

void ReadVertex(const Element& element, NumberReader& numbers, const std::string& path,
                TriangleMesh& mesh) {
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);
  std::vector<double> values;
  for (const Property& property : element.properties) {
    numbers.Next(property, values);
    const std::size_t axis = std::string("xyz").find(property.name);
    if (property.name.size() != 1 || axis == std::string::npos || values.size() != 1) continue;
    position[static_cast<Eigen::Index>(axis)] = values[0];
  }
  if (!position.allFinite()) ThrowFor(path, "PLY vertex without a finite x, y or z");
  mesh.vertices.push_back(position.cast<float>());
}

/// Adds a face as a fan of triangles around its first corner.
void AddFace(const std::vector<double>& corners, TriangleMesh& mesh) {
  const auto index = [&](std::size_t i) { return static_cast<int>(corners[i]); };
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.emplace_back(index(0), index(i - 1), index(i));
  }
}

void ReadFace(const Element& element, NumberReader& numbers, TriangleMesh& mesh) {
  std::vector<double> values;
  for (const Property& property : element.properties) {
    numbers.Next(property, values);
    if (property.name == "vertex_indices" || property.name == "vertex_index") AddFace(values, mesh);
  }
}

void SkipItem(const Element& element, NumberReader& numbers) {
  std::vector<double> values;
  for (const Property& property : element.properties) numbers.Next(property, values);
}

void CheckMesh(const TriangleMesh& mesh, const std::string& path) {
  if (mesh.triangles.empty()) ThrowFor(path, "PLY has no faces");
  const auto num_vertices = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= num_vertices) {
      ThrowFor(path, "PLY face with a corner that is no vertex");
    }
  }
}

}  // namespace

void WriteMesh(const TriangleMesh& mesh, const std::string& path) {
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\ncomment triangle mesh, metres\n"
         << "element vertex " << mesh.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\n"
         << "element face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string bytes = header.str();
  bytes.reserve(bytes.size() + mesh.vertices.size() * sizeof(Eigen::Vector3f) +
                mesh.triangles.size() * kBytesPerTriangle);
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) Append(bytes, vertex[axis]);
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    Append(bytes, kCorners);
    for (int corner = 0; corner < 3; ++corner) Append<std::int32_t>(bytes, triangle[corner]);
  }
  WriteFileAtomically(path, bytes);
}

TriangleMesh ReadMesh(const std::string& path) {
  const std::string bytes = ReadWholeFile(path);
  std::size_t begin = 0;
  const Header header = ParseHeader(bytes, path, begin);
  NumberReader numbers(bytes, begin, header.is_ascii, path);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        ReadVertex(element, numbers, path, mesh);
      } else if (element.name == "face") {
        ReadFace(element, numbers, mesh);
      } else {
        SkipItem(element, numbers);
      }
    }
  }
  CheckMesh(mesh, path);
  return mesh;
}

}  // namespace posefusion
