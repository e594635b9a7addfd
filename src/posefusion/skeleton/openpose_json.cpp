#include "posefusion/skeleton/openpose_json.h"

#include <cstdio>

namespace posefusion {

std::string ToOpenPoseJson(const std::vector<Skeleton>& people) {
  std::string text = "{\"version\":1.3,\"people\":[";
  for (std::size_t i = 0; i < people.size(); ++i) {
    text += i > 0 ? ",{" : "{";
    text += "\"person_id\":[-1],\"pose_keypoints_2d\":[";
    for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
      const Joint& joint = people[i][j];
      std::array<char, 64> numbers{};
      std::snprintf(numbers.data(), numbers.size(), "%s%.3f,%.3f,%.4f", j > 0 ? "," : "",
                    static_cast<double>(joint.u), static_cast<double>(joint.v),
                    static_cast<double>(joint.p));
      text += numbers.data();
    }
    text += "]}";
  }
  return text + "]}\n";
}

}  // namespace posefusion
