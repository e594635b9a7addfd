#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/skeleton/part_grouping_config.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// A limb that the COCO pose networks know: its ends, and where its affinity field (x, then y)
/// stands among the 38 fields.
struct LimbField {
  CocoJoint from;
  CocoJoint to;
  int x_field;
};

/// OpenPose's COCO model (Cao 2017), which the graphs of tf-openpose share.
constexpr std::array<LimbField, 19> kLimbFields = {{{kNeck, kRightShoulder, 12},
                                                    {kNeck, kLeftShoulder, 20},
                                                    {kRightShoulder, kRightElbow, 14},
                                                    {kRightElbow, kRightWrist, 16},
                                                    {kLeftShoulder, kLeftElbow, 22},
                                                    {kLeftElbow, kLeftWrist, 24},
                                                    {kNeck, kRightHip, 0},
                                                    {kRightHip, kRightKnee, 2},
                                                    {kRightKnee, kRightAnkle, 4},
                                                    {kNeck, kLeftHip, 6},
                                                    {kLeftHip, kLeftKnee, 8},
                                                    {kLeftKnee, kLeftAnkle, 10},
                                                    {kNeck, kNose, 28},
                                                    {kNose, kRightEye, 30},
                                                    {kRightEye, kRightEar, 34},
                                                    {kNose, kLeftEye, 32},
                                                    {kLeftEye, kLeftEar, 36},
                                                    {kRightShoulder, kRightEar, 18},
                                                    {kLeftShoulder, kLeftEar, 26}}};

constexpr int kNumAffinityFields = 2 * static_cast<int>(kLimbFields.size());

/// What a pose network says about an image: CV_32FC1 images of one size.
struct PartMaps {
  std::array<cv::Mat, kNumCocoJoints> heat;          ///< how sure a joint is at a pixel, 0 to 1
  std::array<cv::Mat, kNumAffinityFields> affinity;  ///< unit vectors along limbs, x and y in turn
};

/// Finds people in the maps of a pose network, after Cao et al., "Realtime Multi-Person 2D Pose
/// Estimation using Part Affinity Fields" (2017), section 2: joints are peaks of the heat maps; two
/// joints are a limb when the affinity field between them points from one to the other; per limb
/// the best pairs are taken first, each joint once; limbs that share joints are a person.
/// Joints come in pixels of the maps, the most certain people first, kMaxPeople at most.
std::vector<Skeleton> GroupParts(const PartMaps& maps, const PartGroupingConfig& config);

}  // namespace posefusion
