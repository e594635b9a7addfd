#include "posefusion/surfel/surfel_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace posefusion {
namespace {

/// Edge of a group in voxels.
constexpr int kGroupShift = 3;

std::uint64_t Mix(std::uint64_t hash, std::uint64_t value) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL;  // FNV-1a
  return (hash ^ value) * kPrime;
}

std::uint64_t MixFloat(std::uint64_t hash, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return Mix(hash, bits);
}

std::uint64_t DigestChunk(std::uint64_t hash, const SurfelChunk& chunk) {
  for (int s = 0; s < chunk.size; ++s) {
    const auto i = static_cast<std::size_t>(s);
    for (const float value :
         {chunk.x[i], chunk.y[i], chunk.z[i], chunk.nx[i], chunk.ny[i], chunk.nz[i], chunk.red[i],
          chunk.green[i], chunk.blue[i], chunk.radius[i], chunk.confidence[i]}) {
      hash = MixFloat(hash, value);
    }
    for (const std::uint32_t value : {chunk.first_seen[i], chunk.last_seen[i], chunk.id[i]}) {
      hash = Mix(hash, value);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    hash = MixFloat(hash, chunk.box.min[axis]);
    hash = MixFloat(hash, chunk.box.max[axis]);
    hash = Mix(hash, static_cast<std::uint32_t>(chunk.voxel[static_cast<std::size_t>(axis)]));
  }
  for (const std::uint32_t value :
       {static_cast<std::uint32_t>(chunk.size), static_cast<std::uint32_t>(chunk.num_alive),
        chunk.last_change, chunk.recheck_frame, chunk.epoch, chunk.dirty}) {
    hash = Mix(hash, value);
  }
  return hash;
}

int FreeSlot(const SurfelChunk& chunk) {
  if (chunk.size < kChunkCapacity) return chunk.size;
  int slot = 0;
  while (chunk.IsAlive(slot)) ++slot;
  return slot;
}

}  // namespace

std::size_t SurfelMap::KeyHash::operator()(const VoxelKey& key) const {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::int32_t part : key) hash = Mix(hash, static_cast<std::uint32_t>(part));
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

SurfelMap::SurfelMap(const SurfelMapConfig& config) : config_(config) {}

std::uint32_t SurfelMap::BeginFrame(StampNs stamp_ns) {
  if (!logs_.empty()) {
    for (const std::uint32_t index : logs_.back().touched) snapshot_slot_[index] = 0;
  }
  frame_stamps_.push_back(stamp_ns);
  if (config_.undo_frames == 0) return frame();
  if (static_cast<int>(logs_.size()) == config_.undo_frames) {
    Recycle(logs_.front());
    logs_.pop_front();
  }
  ChangeLog& log = logs_.emplace_back();
  log.num_chunks = chunks_.size();
  log.num_surfels = num_surfels_;
  log.next_id = next_id_;
  return frame();
}

std::uint32_t SurfelMap::FirstFrameSince(StampNs stamp_ns) const {
  const auto found = std::lower_bound(frame_stamps_.begin(), frame_stamps_.end(), stamp_ns);
  return static_cast<std::uint32_t>(found - frame_stamps_.begin()) + 1;
}

void SurfelMap::FindVisible(const Frustum& frustum, std::vector<std::uint32_t>& chunks) const {
  chunks.clear();
  for (const Group& group : groups_) {
    if (!frustum.Touches(group.box)) continue;
    for (const std::uint32_t index : group.chunks) {
      const SurfelChunk& candidate = *chunks_[index];
      if (candidate.num_alive > 0 && frustum.Touches(candidate.box)) chunks.push_back(index);
    }
  }
  std::sort(chunks.begin(), chunks.end());
}

void SurfelMap::ReserveSnapshots(const std::vector<std::uint32_t>& chunks) {
  for (const std::uint32_t index : chunks) ReserveSnapshot(index);
}

void SurfelMap::ReserveSnapshot(std::uint32_t index) {
  if (!Logging()) return;
  ChangeLog& log = logs_.back();
  if (index >= log.num_chunks || snapshot_slot_[index] != 0) return;
  log.touched.push_back(index);
  log.before.push_back(TakeSpare());
  snapshot_slot_[index] = static_cast<std::uint32_t>(log.touched.size());
}

SurfelChunk& SurfelMap::Touch(std::uint32_t index) {
  SurfelChunk& current = *chunks_[index];
  if (Logging() && current.last_change != frame() && snapshot_slot_[index] != 0) {
    *logs_.back().before[snapshot_slot_[index] - 1] = current;
  }
  current.last_change = frame();
  current.dirty = 1;
  return current;
}

std::uint32_t SurfelMap::Insert(const Surfel& surfel) {
  const std::uint32_t index = ChunkWithRoom(KeyOf(surfel.position_m));
  ReserveSnapshot(index);
  SurfelChunk& target = Touch(index);
  const int slot = FreeSlot(target);
  Surfel stored = surfel;
  stored.id = next_id_++;
  target.Set(slot, stored);
  target.size = std::max(target.size, slot + 1);
  ++target.num_alive;
  target.box.Add(surfel.position_m);
  ++num_surfels_;
  GroupOf(index).box.Add(surfel.position_m);
  return index;
}

void SurfelMap::Account(std::uint32_t index, int num_removed) {
  num_surfels_ -= static_cast<std::size_t>(num_removed);
  GroupOf(index).box.Add(chunks_[index]->box);
}

void SurfelMap::ScheduleRecheck(std::uint32_t index, std::uint32_t frame) {
  SurfelChunk& waiting = *chunks_[index];
  if (waiting.recheck_frame != 0) return;
  waiting.recheck_frame = frame;
  rechecks_.push_back({frame, index});
  if (Logging()) ++logs_.back().num_rechecks_added;
}

std::vector<std::uint32_t> SurfelMap::TakeDue() {
  std::vector<std::uint32_t> due;
  while (!rechecks_.empty() && rechecks_.front().frame <= frame()) {
    due.push_back(rechecks_.front().chunk);
    if (Logging()) logs_.back().rechecks_taken.push_back(rechecks_.front());
    rechecks_.pop_front();
  }
  return due;
}

bool SurfelMap::UndoFrame() {
  if (logs_.empty()) return false;
  ChangeLog& log = logs_.back();
  while (chunks_.size() > log.num_chunks) RemoveLastChunk();
  for (std::size_t i = 0; i < log.touched.size(); ++i) {
    SurfelChunk& current = *chunks_[log.touched[i]];
    if (current.last_change == frame()) current = *log.before[i];
    snapshot_slot_[log.touched[i]] = 0;
  }
  for (const std::uint32_t index : log.touched) {
    Group& group = GroupOf(index);
    group.box = Box();
    for (const std::uint32_t member : group.chunks) group.box.Add(chunks_[member]->box);
  }
  num_surfels_ = log.num_surfels;
  next_id_ = log.next_id;
  rechecks_.resize(rechecks_.size() - log.num_rechecks_added);
  rechecks_.insert(rechecks_.begin(), log.rechecks_taken.begin(), log.rechecks_taken.end());
  Recycle(log);
  logs_.pop_back();
  frame_stamps_.pop_back();
  return true;
}

SurfelCloud SurfelMap::Export(float min_confidence) const {
  SurfelCloud cloud;
  for (const auto& stored : chunks_) {
    for (int slot = 0; slot < stored->size; ++slot) {
      if (!stored->IsAlive(slot)) continue;
      const Surfel surfel = stored->Get(slot);
      if (surfel.confidence < min_confidence) continue;
      cloud.position_m.push_back(surfel.position_m);
      cloud.normal.push_back(surfel.normal);
      const auto byte = [&](int channel) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(surfel.rgb[channel], 0.F, 255.F)));
      };
      cloud.rgb.push_back({byte(0), byte(1), byte(2)});
      cloud.radius_m.push_back(surfel.radius_m);
      cloud.confidence.push_back(surfel.confidence);
      cloud.first_seen_ns.push_back(StampOf(surfel.first_seen));
      cloud.last_seen_ns.push_back(StampOf(surfel.last_seen));
    }
  }
  return cloud;
}

std::uint64_t SurfelMap::Digest() const {
  std::uint64_t hash = Mix(Mix(num_surfels_, next_id_), chunks_.size());
  for (const auto& stored : chunks_) hash = DigestChunk(hash, *stored);
  for (const Recheck& recheck : rechecks_) hash = Mix(Mix(hash, recheck.frame), recheck.chunk);
  for (const StampNs stamp : frame_stamps_) hash = Mix(hash, static_cast<std::uint64_t>(stamp));
  for (const Group& group : groups_) {
    for (int axis = 0; axis < 3; ++axis) {
      hash = MixFloat(MixFloat(hash, group.box.min[axis]), group.box.max[axis]);
    }
  }
  return hash;
}

SurfelMap::VoxelKey SurfelMap::KeyOf(const Eigen::Vector3f& position) const {
  VoxelKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const double voxel = static_cast<double>(position[axis]) / config_.voxel_size_m;
    key[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::floor(voxel));
  }
  return key;
}

SurfelMap::VoxelKey SurfelMap::GroupKeyOf(const VoxelKey& voxel) {
  return {voxel[0] >> kGroupShift, voxel[1] >> kGroupShift, voxel[2] >> kGroupShift};
}

std::uint32_t SurfelMap::ChunkWithRoom(const VoxelKey& voxel) {
  const auto found = voxels_.find(voxel);
  if (found != voxels_.end()) {
    const auto& members = found->second;
    for (auto index = members.rbegin(); index != members.rend(); ++index) {
      if (chunks_[*index]->num_alive < kChunkCapacity) return *index;
    }
  }
  return AddChunk(voxel);
}

std::uint32_t SurfelMap::AddChunk(const VoxelKey& voxel) {
  const auto index = static_cast<std::uint32_t>(chunks_.size());
  chunks_.push_back(std::make_unique<SurfelChunk>());
  chunks_.back()->radius.fill(0);
  chunks_.back()->voxel = voxel;
  snapshot_slot_.push_back(0);
  voxels_[voxel].push_back(index);
  const auto [group, is_new] =
      group_index_.try_emplace(GroupKeyOf(voxel), static_cast<std::uint32_t>(groups_.size()));
  if (is_new) groups_.emplace_back();
  groups_[group->second].chunks.push_back(index);
  return index;
}

void SurfelMap::RemoveLastChunk() {
  const VoxelKey voxel = chunks_.back()->voxel;
  Group& group = GroupOf(static_cast<std::uint32_t>(chunks_.size() - 1));
  group.chunks.pop_back();
  group.box = Box();
  for (const std::uint32_t member : group.chunks) group.box.Add(chunks_[member]->box);
  if (group.chunks.empty()) {
    groups_.pop_back();  // groups are created in the order of their first chunks
    group_index_.erase(GroupKeyOf(voxel));
  }
  auto& members = voxels_[voxel];
  members.pop_back();
  if (members.empty()) voxels_.erase(voxel);
  chunks_.pop_back();
  snapshot_slot_.pop_back();
}

SurfelMap::Group& SurfelMap::GroupOf(std::uint32_t index) {
  return groups_[group_index_.at(GroupKeyOf(chunks_[index]->voxel))];
}

std::unique_ptr<SurfelChunk> SurfelMap::TakeSpare() {
  if (spare_.empty()) return std::make_unique<SurfelChunk>();
  std::unique_ptr<SurfelChunk> chunk = std::move(spare_.back());
  spare_.pop_back();
  return chunk;
}

void SurfelMap::Recycle(ChangeLog& log) {
  for (std::unique_ptr<SurfelChunk>& before : log.before) spare_.push_back(std::move(before));
  log.before.clear();
}

}  // namespace posefusion
