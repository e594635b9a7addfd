#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/surfel/frustum.h"
#include "posefusion/surfel/surfel_chunk.h"
#include "posefusion/surfel/surfel_cloud.h"

namespace posefusion {

struct SurfelMapConfig {
  double voxel_size_m = 0.25;       ///< edge of the coarse voxels that chunks belong to
  double stable_confidence = 10.0;  ///< surfels of at least this confidence are stable
  int undo_frames = 3;              ///< so many frames can be taken back
};

template <class V>
void Describe(V& v, SurfelMapConfig& c) {
  v.Field("voxel_size_m", c.voxel_size_m, 0.05, 10.0);
  v.Field("stable_confidence", c.stable_confidence, 0.0, 1e4);
  v.Field("undo_frames", c.undo_frames, 0, 100);
}

/// The dense map: surfels in chunks by coarse voxel, and what the last frames changed.
///
/// Changes happen between BeginFrame calls. Whoever changes the surfels of a chunk calls Touch for
/// it first; different chunks may then be changed by different threads. Everything else is for one
/// thread. UndoFrame takes the last frame back, bit by bit.
class SurfelMap {
 public:
  explicit SurfelMap(const SurfelMapConfig& config);

  /// Starts the changes of a new frame and returns its index (1, 2, ...).
  std::uint32_t BeginFrame(StampNs stamp_ns);

  /// Index of the current frame, 0 before the first.
  std::uint32_t frame() const { return static_cast<std::uint32_t>(frame_stamps_.size()); }

  float stable_confidence() const { return static_cast<float>(config_.stable_confidence); }

  /// Stamp of frame 1 .. frame().
  StampNs StampOf(std::uint32_t frame) const { return frame_stamps_[frame - 1]; }

  /// The first frame not older than the stamp; frame() + 1 when all are older.
  std::uint32_t FirstFrameSince(StampNs stamp_ns) const;

  /// Chunks that a frustum touches, in increasing order.
  void FindVisible(const Frustum& frustum, std::vector<std::uint32_t>& chunks) const;

  const SurfelChunk& chunk(std::uint32_t index) const { return *chunks_[index]; }
  std::size_t NumChunks() const { return chunks_.size(); }
  std::size_t NumSurfels() const { return num_surfels_; }

  /// Prepares these chunks for Touch. One thread.
  void ReserveSnapshots(const std::vector<std::uint32_t>& chunks);

  /// The chunk for changing; keeps how it was before this frame. Needs ReserveSnapshots with it.
  /// Different chunks may be called for from different threads.
  SurfelChunk& Touch(std::uint32_t index);

  /// Adds a surfel, its id is chosen here, and returns its chunk. May touch or add that chunk.
  /// One thread.
  std::uint32_t Insert(const Surfel& surfel);

  /// Brings counts and the boxes of groups up to date with chunks that were changed through Touch.
  void Account(std::uint32_t index, int num_removed);

  /// Asks for a chunk to be returned by TakeDue at a later frame. Frames must not decrease between
  /// calls. Each chunk waits at most once.
  void ScheduleRecheck(std::uint32_t index, std::uint32_t frame);

  /// Chunks whose recheck is due at the current frame.
  std::vector<std::uint32_t> TakeDue();

  /// Takes back everything since the last BeginFrame, that included. False when the log is empty.
  bool UndoFrame();

  /// Number of frames that can be taken back now.
  int NumUndoable() const { return static_cast<int>(logs_.size()); }

  /// Copies surfels of at least this confidence.
  SurfelCloud Export(float min_confidence) const;

  /// A number that depends on every bit of the map: equal maps have equal digests.
  std::uint64_t Digest() const;

 private:
  using VoxelKey = std::array<std::int32_t, 3>;
  struct KeyHash {
    std::size_t operator()(const VoxelKey& key) const;
  };
  /// Chunks of a cube of voxels, for culling many at once.
  struct Group {
    Box box;
    std::vector<std::uint32_t> chunks;
  };
  struct Recheck {
    std::uint32_t frame;
    std::uint32_t chunk;
  };
  /// What one frame changed: how things were before it.
  struct ChangeLog {
    std::vector<std::uint32_t> touched;
    std::vector<std::unique_ptr<SurfelChunk>> before;  ///< by position in `touched`
    std::size_t num_chunks = 0;
    std::size_t num_surfels = 0;
    std::uint32_t next_id = 0;
    std::size_t num_rechecks_added = 0;
    std::vector<Recheck> rechecks_taken;
  };

  VoxelKey KeyOf(const Eigen::Vector3f& position) const;
  static VoxelKey GroupKeyOf(const VoxelKey& voxel);
  std::uint32_t ChunkWithRoom(const VoxelKey& voxel);
  std::uint32_t AddChunk(const VoxelKey& voxel);
  void RemoveLastChunk();
  Group& GroupOf(std::uint32_t index);
  void ReserveSnapshot(std::uint32_t index);
  std::unique_ptr<SurfelChunk> TakeSpare();
  void Recycle(ChangeLog& log);
  bool Logging() const { return config_.undo_frames > 0 && !logs_.empty(); }

  SurfelMapConfig config_;
  std::vector<std::unique_ptr<SurfelChunk>> chunks_;
  std::unordered_map<VoxelKey, std::vector<std::uint32_t>, KeyHash> voxels_;
  std::unordered_map<VoxelKey, std::uint32_t, KeyHash> group_index_;
  std::vector<Group> groups_;
  std::vector<StampNs> frame_stamps_;
  std::size_t num_surfels_ = 0;
  std::uint32_t next_id_ = 1;
  std::deque<Recheck> rechecks_;
  std::deque<ChangeLog> logs_;
  std::vector<std::uint32_t> snapshot_slot_;  ///< per chunk: position in the log + 1, 0 = none
  std::vector<std::unique_ptr<SurfelChunk>> spare_;
};

}  // namespace posefusion
