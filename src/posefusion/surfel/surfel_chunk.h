#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace posefusion {

constexpr int kChunkCapacity = 512;

/// Axis-aligned box in the map frame, metres. Empty until something is added.
struct Box {
  Eigen::Vector3f min = Eigen::Vector3f::Constant(1e30F);
  Eigen::Vector3f max = Eigen::Vector3f::Constant(-1e30F);

  void Add(const Eigen::Vector3f& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void Add(const Box& box) {
    min = min.cwiseMin(box.min);
    max = max.cwiseMax(box.max);
  }
  bool empty() const { return min.x() > max.x(); }
};

/// A surfel: a disc of the static room's surface. Map frame, z up.
struct Surfel {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit, towards the cameras that saw it
  Eigen::Vector3f rgb = Eigen::Vector3f::Zero();      ///< 0..255
  float radius_m = 0;
  float confidence = 0;          ///< sum of measurement weights
  std::uint32_t first_seen = 0;  ///< frame index of the map
  std::uint32_t last_seen = 0;   ///< frame index of the map
  std::uint32_t id = 0;          ///< given by the map, never used twice
};

/// Surfels of one coarse voxel as a structure of arrays. A slot keeps its surfel as long as that
/// lives; slots with radius 0 are free. Plain data without pointers: a copy is a snapshot.
struct SurfelChunk {
  using Floats = std::array<float, kChunkCapacity>;
  using Indices = std::array<std::uint32_t, kChunkCapacity>;

  Floats x, y, z;
  Floats nx, ny, nz;
  Floats red, green, blue;
  Floats radius;
  Floats confidence;
  Indices first_seen, last_seen, id;

  std::array<std::int32_t, 3> voxel{};  ///< coarse voxel that the surfels were born in
  std::int32_t size = 0;                ///< slots at and behind it have never been used
  std::int32_t num_alive = 0;
  Box box;                          ///< encloses all surfels, grows only
  std::uint32_t last_change = 0;    ///< frame index of the last change
  std::uint32_t recheck_frame = 0;  ///< when unstable surfels are looked at, 0 = not due
  std::uint32_t epoch = 0;          ///< last deformation that has been applied
  std::uint32_t dirty = 1;          ///< changed since it was last saved or shown

  bool IsAlive(int slot) const { return radius[static_cast<std::size_t>(slot)] > 0; }
  Eigen::Vector3f Position(int slot) const;
  Surfel Get(int slot) const;
  void Set(int slot, const Surfel& surfel);
};

}  // namespace posefusion
