#include "skeleton_picture.h"

#include <array>
#include <opencv2/imgproc.hpp>

namespace posefusion {
namespace {

const std::array<cv::Scalar, 6> kColours = {
    {{60, 220, 60}, {40, 160, 255}, {255, 120, 60}, {60, 60, 240}, {230, 220, 40}, {220, 60, 220}}};

cv::Point ToPixel(const Joint& joint) { return {cvRound(joint.u), cvRound(joint.v)}; }

void DrawSkeleton(const Skeleton& person, const cv::Scalar& colour, cv::Mat& bgr) {
  for (const Bone& bone : kBones) {
    const Joint& from = person[bone.from];
    const Joint& to = person[bone.to];
    if (from.p <= 0 || to.p <= 0) continue;
    cv::line(bgr, ToPixel(from), ToPixel(to), colour, 2, cv::LINE_AA);
  }
  for (const Joint& joint : person) {
    if (joint.p > 0) cv::circle(bgr, ToPixel(joint), 3, cv::Scalar::all(255), cv::FILLED);
  }
}

}  // namespace

void DrawSkeletons(const std::vector<Skeleton>& people, cv::Mat& bgr) {
  for (std::size_t i = 0; i < people.size(); ++i) {
    DrawSkeleton(people[i], kColours[i % kColours.size()], bgr);
  }
}

}  // namespace posefusion
