#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/skeleton/openpose_json.h"

namespace posefusion::testing {

/// A person whose joint j is at (x + j, y + 2 j), all of confidence p.
inline Skeleton PersonAt(float x, float y, float p = 0.5F) {
  Skeleton person;
  for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
    const auto offset = static_cast<float>(j);
    person[j] = {x + offset, y + 2 * offset, p};
  }
  return person;
}

inline void WriteText(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

inline void WritePeople(const std::string& path, const std::vector<Skeleton>& people) {
  WriteText(path, ToOpenPoseJson(people));
}

/// What a skeleton source looks at, of a 640 x 480 image.
inline RgbdFrame FrameAt(StampNs stamp_ns, int index = -1) {
  RgbdFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.index = index;
  frame.camera.width = 640;
  frame.camera.height = 480;
  return frame;
}

/// Joints as numbers, for comparing bit by bit.
inline std::vector<float> Numbers(const std::vector<Skeleton>& people) {
  std::vector<float> numbers;
  for (const Skeleton& person : people) {
    for (const Joint& joint : person) {
      numbers.insert(numbers.end(), {joint.u, joint.v, joint.p});
    }
  }
  return numbers;
}

}  // namespace posefusion::testing
