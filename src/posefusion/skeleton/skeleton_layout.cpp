#include "posefusion/skeleton/skeleton_layout.h"

#include <array>
#include <cassert>
#include <string_view>

namespace posefusion {
namespace {

constexpr std::size_t kNumBody25Joints = 25;

/// Names and order of the joints from the description of OpenPose's output.
constexpr std::array<std::string_view, kNumCocoJoints> kCocoNames = {
    "Nose",  "Neck",   "RShoulder", "RElbow", "RWrist", "LShoulder", "LElbow", "LWrist", "RHip",
    "RKnee", "RAnkle", "LHip",      "LKnee",  "LAnkle", "REye",      "LEye",   "REar",   "LEar"};
constexpr std::array<std::string_view, kNumBody25Joints> kBody25Names = {
    "Nose", "Neck",    "RShoulder", "RElbow", "RWrist",  "LShoulder", "LElbow", "LWrist", "MidHip",
    "RHip", "RKnee",   "RAnkle",    "LHip",   "LKnee",   "LAnkle",    "REye",   "LEye",   "REar",
    "LEar", "LBigToe", "LSmallToe", "LHeel",  "RBigToe", "RSmallToe", "RHeel"};

/// For each joint of COCO-18 its number in BODY_25.
constexpr std::array<std::size_t, kNumCocoJoints> NumbersInBody25() {
  std::array<std::size_t, kNumCocoJoints> numbers{};
  for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
    while (kBody25Names[numbers[i]] != kCocoNames[i]) ++numbers[i];
  }
  return numbers;
}

constexpr std::array<std::size_t, kNumCocoJoints> kNumberInBody25 = NumbersInBody25();

}  // namespace

std::size_t NumJoints(SkeletonLayout layout) {
  return layout == SkeletonLayout::kBody25 ? kBody25Names.size() : kCocoNames.size();
}

const char* ToString(SkeletonLayout layout) {
  return layout == SkeletonLayout::kBody25 ? "body25" : "coco18";
}

std::optional<SkeletonLayout> ParseLayout(const std::string& name) {
  for (const SkeletonLayout layout : {SkeletonLayout::kCoco18, SkeletonLayout::kBody25}) {
    if (name == ToString(layout)) return layout;
  }
  return std::nullopt;
}

std::optional<SkeletonLayout> LayoutWithJoints(std::size_t num_joints) {
  for (const SkeletonLayout layout : {SkeletonLayout::kCoco18, SkeletonLayout::kBody25}) {
    if (num_joints == NumJoints(layout)) return layout;
  }
  return std::nullopt;
}

Skeleton ToCocoOrder(SkeletonLayout layout, const std::vector<Joint>& joints) {
  assert(joints.size() == NumJoints(layout));
  Skeleton skeleton;
  for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
    skeleton[i] = joints[layout == SkeletonLayout::kBody25 ? kNumberInBody25[i] : i];
  }
  return skeleton;
}

}  // namespace posefusion
