#include "posefusion/skeleton/skeleton_folder.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "posefusion/common/atomic_file.h"
#include "posefusion/skeleton/nearest_stamp.h"
#include "posefusion/skeleton/openpose_json.h"
#include "posefusion/skeleton/skeleton_checks.h"

namespace posefusion {
namespace {

/// The whole text, unless it is so large that nobody should read it.
std::string ReadSmallFile(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size > kMaxOpenPoseBytes) {
    throw std::runtime_error(path + ": has " + std::to_string(size) + " bytes, more than " +
                             std::to_string(kMaxOpenPoseBytes));
  }
  return ReadWholeFile(path);
}

}  // namespace

SkeletonFolder::SkeletonFolder(const std::string& folder)
    : files_(ListKeypointFiles(folder)), clock_check_(folder) {
  if (files_.paths.empty()) {
    notes_.push_back(folder + ": no keypoint files (STAMP.json or NAME_000000000012_keypoints" +
                     ".json): people stay unknown");
  } else if (files_.num_unknown > 0) {
    notes_.push_back(folder + ": " + std::to_string(files_.num_unknown) +
                     " .json files have neither a stamp nor a number as their names");
  }
}

void SkeletonFolder::Offer(const RgbdFrame& frame) {
  const Entry file = FindFile(frame);
  if (file == files_.paths.end()) return CheckClock(frame);
  used_.insert(file->first);
  waiting_.Add(ReadFile(file->second, frame));
}

SkeletonFolder::Entry SkeletonFolder::FindFile(const RgbdFrame& frame) const {
  if (files_.numbered) return files_.paths.find(frame.index);
  return FindStamp(files_.paths, frame.stamp_ns, kSameImageNs);
}

/// Files may be few, so only those that have never fitted are suspected.
void SkeletonFolder::CheckClock(const RgbdFrame& frame) {
  if (files_.numbered || files_.paths.empty() || !used_.empty()) return;
  const StampNs nearest_ns = NearestStamp(files_.paths, frame.stamp_ns)->first;
  if (auto note = clock_check_.Compare(nearest_ns, frame.stamp_ns)) {
    notes_.push_back(std::move(*note));
  }
}

Skeletons SkeletonFolder::ReadFile(const std::string& path, const RgbdFrame& frame) {
  OpenPosePeople read = ReadOpenPoseJson(ReadSmallFile(path), path);
  if (read.num_left_out > 0 && !said_too_many_) {
    said_too_many_ = true;
    notes_.push_back(path + ": more than " + std::to_string(kMaxPeople) +
                     " people; the most certain are used, here and in other files");
  }
  Skeletons skeletons;
  skeletons.stamp_ns = frame.stamp_ns;
  skeletons.layout = read.layout;
  skeletons.people = std::move(read.people);
  DropUnusable(skeletons.people, frame.camera.width, frame.camera.height);
  const auto arrival = FindStamp(files_.arrival_ns, frame.stamp_ns, kSameImageNs);
  skeletons.arrival_ns = arrival == files_.arrival_ns.end() ? frame.stamp_ns : arrival->second;
  return skeletons;
}

std::vector<std::string> SkeletonFolder::TakeNotes() { return std::exchange(notes_, {}); }

SkeletonCounts SkeletonFolder::counts() const {
  return {static_cast<int>(used_.size()), static_cast<int>(files_.paths.size() - used_.size())};
}

}  // namespace posefusion
