#include "posefusion/dataset/moved_objects_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/text_lines.h"
#include "posefusion/dataset/mesh_file.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

constexpr char kComment[] = "# start_stamp end_stamp name dx dy dz mesh_before mesh_after\n";
constexpr char kSubfolder[] = "moved_objects";
constexpr std::size_t kColumns = 6;  ///< without meshes
constexpr std::size_t kColumnsWithMeshes = 8;

/// Nothing for columns 3 to 5 that are no numbers.
std::optional<Eigen::Vector3d> ParseOffset(const std::vector<std::string>& columns) {
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& text = columns[static_cast<std::size_t>(3 + axis)];
    char* end = nullptr;
    offset[axis] = std::strtod(text.c_str(), &end);
    if (*end != '\0' || !std::isfinite(offset[axis])) return std::nullopt;
  }
  return offset;
}

std::optional<MovedSurfaces> ParseLine(const std::vector<std::string>& columns) {
  if (columns.size() != kColumns && columns.size() != kColumnsWithMeshes) return std::nullopt;
  const auto begin_ns = ParseStamp(columns[0]);
  const auto end_ns = ParseStamp(columns[1]);
  const auto offset = ParseOffset(columns);
  if (!begin_ns || !end_ns || *end_ns < *begin_ns || !offset) return std::nullopt;
  return MovedSurfaces{columns[2], *begin_ns, *end_ns, *offset, {}, {}};
}

}  // namespace

void WriteMovedObjects(const std::vector<MovedSurfaces>& objects, const std::string& folder) {
  std::string text = kComment;
  std::error_code error;
  if (!objects.empty()) fs::create_directories(folder + "/" + kSubfolder, error);
  if (error) throw std::runtime_error(folder + "/" + kSubfolder + ": " + error.message());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const MovedSurfaces& object = objects[i];
    const std::string mesh = kSubfolder + ("/" + std::to_string(i)) + "_" + object.name;
    const std::string before = mesh + "_before.ply";
    const std::string after = mesh + "_after.ply";
    WriteMesh(object.before, folder + "/" + before);
    WriteMesh(object.after, folder + "/" + after);
    std::array<char, 96> offset{};
    std::snprintf(offset.data(), offset.size(), " %.4f %.4f %.4f ", object.offset_m.x(),
                  object.offset_m.y(), object.offset_m.z());
    text += FormatStamp(object.begin_ns) + " " + FormatStamp(object.end_ns) + " " + object.name +
            offset.data() + before + " " + after + "\n";
  }
  WriteFileAtomically(folder + "/moved_objects.txt", text);
}

std::vector<MovedSurfaces> ReadMovedObjects(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::vector<MovedSurfaces> objects;
  for (const TextLine& line : ReadTextLines(path)) {
    auto object = ParseLine(line.columns);
    if (!object) {
      throw std::runtime_error(LineName(path, line) +
                               ": expected 'start_stamp end_stamp name dx dy dz mesh_before "
                               "mesh_after'");
    }
    if (line.columns.size() == kColumnsWithMeshes) {
      object->before = ReadMesh(folder / line.columns[6]);
      object->after = ReadMesh(folder / line.columns[7]);
    }
    objects.push_back(std::move(*object));
  }
  return objects;
}

}  // namespace posefusion
