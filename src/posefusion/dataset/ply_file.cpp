#include "posefusion/dataset/ply_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/ply_header.h"

// PCL's PLYWriter cannot write comments and always adds a camera or range-grid element, which
// viewers take for more than it is; Debian 12 has no small PLY library. Hence by hand.

namespace posefusion {
namespace {

constexpr char kOriginComment[] = "stamp_origin_ns";
constexpr std::size_t kBytesPerSurfel = 51;

std::string HeaderText(std::size_t num_surfels, StampNs origin_ns) {
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\ncomment posefusion surfel map, metres, z up\n"
         << "comment " << kOriginComment << " " << origin_ns << "\nelement vertex " << num_surfels;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header << "\nproperty float " << name;
  for (const char* name : {"red", "green", "blue"}) header << "\nproperty uchar " << name;
  for (const char* name : {"radius", "confidence"}) header << "\nproperty float " << name;
  for (const char* name : {"first_seen", "last_seen"}) header << "\nproperty double " << name;
  header << "\nend_header\n";
  return header.str();
}

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void AppendSurfel(std::string& bytes, const SurfelCloud& cloud, std::size_t i, StampNs origin_ns) {
  for (int axis = 0; axis < 3; ++axis) Append(bytes, cloud.position_m[i][axis]);
  for (int axis = 0; axis < 3; ++axis) Append(bytes, cloud.normal[i][axis]);
  for (const std::uint8_t channel : cloud.rgb[i]) Append(bytes, channel);
  Append(bytes, cloud.radius_m[i]);
  Append(bytes, cloud.confidence[i]);
  Append(bytes, SecondsBetween(origin_ns, cloud.first_seen_ns[i]));
  Append(bytes, SecondsBetween(origin_ns, cloud.last_seen_ns[i]));
}

/// One property of all vertices; `read` is null where the file does not have it.
struct Column {
  const char* first = nullptr;
  std::size_t stride = 0;
  double (*read)(const char*) = nullptr;

  double operator()(std::size_t vertex) const {
    return read == nullptr ? 0 : read(first + vertex * stride);
  }
  float Float(std::size_t vertex) const { return static_cast<float>((*this)(vertex)); }
};

Column FindColumn(const std::string& bytes, const PlyHeader& header, const std::string& name) {
  const auto found = header.properties.find(name);
  if (found == header.properties.end()) return {};
  return {bytes.data() + header.header_bytes + found->second.offset, header.vertex_bytes,
          found->second.read};
}

StampNs Origin(const PlyHeader& header) {
  const auto found = header.comments.find(kOriginComment);
  StampNs origin_ns = 0;
  if (found != header.comments.end()) std::istringstream(found->second) >> origin_ns;
  return origin_ns;
}

}  // namespace

void WritePly(const SurfelCloud& cloud, const std::string& path) {
  const auto earliest = std::min_element(cloud.first_seen_ns.begin(), cloud.first_seen_ns.end());
  const StampNs origin_ns = earliest == cloud.first_seen_ns.end() ? 0 : *earliest;
  std::string bytes = HeaderText(cloud.size(), origin_ns);
  bytes.reserve(bytes.size() + cloud.size() * kBytesPerSurfel);
  for (std::size_t i = 0; i < cloud.size(); ++i) AppendSurfel(bytes, cloud, i, origin_ns);
  WriteFileAtomically(path, bytes);
}

SurfelCloud ReadPly(const std::string& path) {
  const std::string bytes = ReadWholeFile(path);
  const PlyHeader header = ParsePlyHeader(bytes, path);
  const auto column = [&](const char* name) { return FindColumn(bytes, header, name); };
  const std::array<Column, 3> position = {column("x"), column("y"), column("z")};
  for (const Column& axis : position) {
    if (axis.read == nullptr) throw std::runtime_error(path + ": PLY vertices lack x, y or z");
  }
  const std::array<Column, 3> normal = {column("nx"), column("ny"), column("nz")};
  const std::array<Column, 3> rgb = {column("red"), column("green"), column("blue")};
  const Column radius = column("radius");
  const Column confidence = column("confidence");
  const Column first_seen = column("first_seen");
  const Column last_seen = column("last_seen");
  const auto byte = [](double value) { return static_cast<std::uint8_t>(value); };
  const StampNs origin_ns = Origin(header);
  SurfelCloud cloud;
  for (std::size_t i = 0; i < header.num_vertices; ++i) {
    cloud.position_m.emplace_back(position[0].Float(i), position[1].Float(i), position[2].Float(i));
    cloud.normal.emplace_back(normal[0].Float(i), normal[1].Float(i), normal[2].Float(i));
    cloud.rgb.push_back({byte(rgb[0](i)), byte(rgb[1](i)), byte(rgb[2](i))});
    cloud.radius_m.push_back(radius.Float(i));
    cloud.confidence.push_back(confidence.Float(i));
    cloud.first_seen_ns.push_back(origin_ns + StampFromSeconds(first_seen(i)));
    cloud.last_seen_ns.push_back(origin_ns + StampFromSeconds(last_seen(i)));
  }
  return cloud;
}

}  // namespace posefusion
