#pragma once

#include <string>

#include "posefusion/dataset/triangle_mesh.h"

namespace posefusion {

/// Writes a mesh as binary little-endian PLY (float x y z; triangles as uchar count and int
/// indices). Replaces the file at once.
/// @throws std::runtime_error naming a file that cannot be written.
void WriteMesh(const TriangleMesh& mesh, const std::string& path);

/// Reads a mesh from an ASCII or binary little-endian PLY of any scalar types. Faces with more than
/// three corners become fans of triangles; other properties and elements are skipped.
/// @throws std::runtime_error naming a file that cannot be read or holds no mesh: no faces, an
/// index without a vertex, a coordinate that is not finite, or an early end.
TriangleMesh ReadMesh(const std::string& path);

}  // namespace posefusion
