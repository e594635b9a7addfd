#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace posefusion {

/// A scalar type of the PLY format.
struct PlyScalarType {
  std::size_t size = 0;                   ///< bytes
  double (*read)(const char*) = nullptr;  ///< little-endian bytes to number
};

/// The type with an old or a new name ("uchar", "uint8"); null when there is none.
const PlyScalarType* FindPlyScalarType(const std::string& name);

/// A scalar of a PLY vertex: where its bytes are and how they become a number.
struct PlyProperty {
  std::size_t offset = 0;                 ///< from the start of the vertex
  double (*read)(const char*) = nullptr;  ///< little-endian bytes to number
};

/// What the header of a binary little-endian PLY file says about its vertices.
struct PlyHeader {
  std::size_t num_vertices = 0;
  std::size_t vertex_bytes = 0;
  std::map<std::string, PlyProperty> properties;  ///< of the vertices, by name
  std::map<std::string, std::string> comments;    ///< first word -> second word
  std::size_t header_bytes = 0;                   ///< the first vertex follows
};

/// Parses the start of `bytes`. @throws std::runtime_error naming `path` when it is no PLY file,
/// not binary little-endian, does not begin with vertices of scalars, or has too few bytes for
/// them.
PlyHeader ParsePlyHeader(const std::string& bytes, const std::string& path);

}  // namespace posefusion
