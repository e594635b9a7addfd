#include "posefusion/segmentation/seeds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "posefusion/segmentation/depth_layers.h"
#include "posefusion/segmentation/pixel_rays.h"

namespace posefusion {
namespace {

/// Lengths of kBones in a tall person, metres, in their order.
constexpr std::array<float, kBones.size()> kBoneLengths = {
    0.25F, 0.25F, 0.36F, 0.34F, 0.36F, 0.34F, 0.65F, 0.50F, 0.50F, 0.65F,
    0.50F, 0.50F, 0.32F, 0.12F, 0.20F, 0.12F, 0.20F, 0.65F, 0.65F};

constexpr float kSurfaceNoise = 0.15F;  ///< joints are lifted to skin: bones seem so much longer
/// Joints less certain than kCertain are often hidden by something that is nearer: their depth has
/// to agree with the body's so much better, down to this share of the tolerance.
constexpr float kCertain = 0.5F;
constexpr float kLeastTolerance = 0.3F;
constexpr int kBoneWindow = 2;        ///< pixels
constexpr float kTrunkLength = 0.5F;  ///< metres
constexpr float kLegLength = 0.9F;
constexpr float kTrunkHalfWidth = 0.4F;
constexpr float kUpperArm = 0.35F;
constexpr float kForearm = 0.5F;  ///< and hand
constexpr float kGuardStep = 0.15F;
/// Limbs that end outside the image begin this share of their length from its border.
constexpr float kBorderShare = 0.33F;
constexpr float kTrunkWeight = 2;  ///< trunk joints say more about where the body is

bool IsTrunk(std::size_t joint) {
  return joint == kNeck || joint == kRightShoulder || joint == kLeftShoulder ||
         joint == kRightHip || joint == kLeftHip;
}

/// Lifts one person.
class Lifting {
 public:
  Lifting(const Skeleton& skeleton, const RgbdFrame& frame, const SeedConfig& config,
          const Eigen::Vector3f& down)
      : skeleton_(skeleton),
        camera_(frame.camera),
        config_(config),
        down_(down),
        layers_(frame.depth_m, static_cast<float>(config.layer_gap_m),
                static_cast<float>(config.min_depth_m), static_cast<float>(config.max_depth_m)) {}

  PersonSeeds Run() {
    ReadLayers();
    FindBodyDepth();
    if (result_.body_depth_m <= 0) return result_;
    LiftJoints();
    DropFarJoints();
    TakeJoints();
    if (config_.seed_along_bones) SeedBones();
    if (config_.seed_extremities) SeedExtremities();
    FindUnseenParts();
    return result_;
  }

 private:
  void ReadLayers() {
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      const Joint& joint = skeleton_[i];
      if (!(joint.p > 0) || joint.p < static_cast<float>(config_.min_joint_confidence)) continue;
      joint_layers_[i] = layers_.At(joint.u, joint.v, config_.window_px);
    }
  }

  /// How well the joints agree with a body at depth z.
  float Agreement(float z) const {
    float sum = 0;
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      float best = 0;
      for (const DepthLayer& layer : joint_layers_[i]) {
        const float difference = std::abs(layer.depth_m - z);
        best = std::max(best, 1 - difference / static_cast<float>(config_.max_body_depth_m));
      }
      sum += best * skeleton_[i].p * (IsTrunk(i) ? kTrunkWeight : 1);
    }
    return sum;
  }

  void FindBodyDepth() {
    float best = 0;
    for (const auto& layers : joint_layers_) {
      for (const DepthLayer& layer : layers) {
        const float agreement = Agreement(layer.depth_m);
        if (agreement < best) continue;
        if (agreement == best && layer.depth_m > result_.body_depth_m) continue;
        best = agreement;
        result_.body_depth_m = layer.depth_m;
      }
    }
  }

  /// The surface nearest to a depth, when it is within `tolerance_m`.
  static std::optional<float> NearestLayer(const std::vector<DepthLayer>& layers, float z,
                                           float tolerance_m) {
    std::optional<float> nearest;
    for (const DepthLayer& layer : layers) {
      const float difference = std::abs(layer.depth_m - z);
      if (difference > tolerance_m) continue;
      if (!nearest || difference < std::abs(*nearest - z)) nearest = layer.depth_m;
    }
    return nearest;
  }

  Seed SeedAt(float u, float v, float z, float radius_share) const {
    const Eigen::Vector2f ray = RayOf(camera_, u, v).cast<float>();
    return {{u, v}, {ray.x() * z, ray.y() * z, z}, radius_share};
  }

  Seed JointAt(std::size_t joint, float z) const {
    return SeedAt(skeleton_[joint].u, skeleton_[joint].v, z, RadiusShareOf(joint));
  }

  float RadiusShareOf(std::size_t joint) const {
    switch (joint) {
      case kRightElbow:
      case kLeftElbow:
      case kRightWrist:
      case kLeftWrist:
        return static_cast<float>(config_.arm_radius_share);
      case kRightHip:
      case kLeftHip:
      case kRightKnee:
      case kLeftKnee:
      case kRightAnkle:
      case kLeftAnkle:
        return static_cast<float>(config_.leg_radius_share);
      default:
        return 1;
    }
  }

  void LiftJoints() {
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      const float tolerance_m = static_cast<float>(config_.max_body_depth_m) *
                                std::clamp(skeleton_[i].p / kCertain, kLeastTolerance, 1.0F);
      const auto z = NearestLayer(joint_layers_[i], result_.body_depth_m, tolerance_m);
      if (z) joints_[i] = JointAt(i, *z);
    }
    while (LiftAlongBones()) continue;
  }

  /// A body seen from above is deeper than max_body_depth_m: certain joints follow from those that
  /// they hang on. Returns whether any did.
  bool LiftAlongBones() {
    bool lifted = false;
    for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
      const auto [from, to] = kBones[bone];
      if (joints_[from] && !joints_[to]) lifted |= LiftFrom(*joints_[from], to, bone);
      if (joints_[to] && !joints_[from]) lifted |= LiftFrom(*joints_[to], from, bone);
    }
    return lifted;
  }

  bool LiftFrom(const Seed& known, std::size_t joint, std::size_t bone) {
    if (skeleton_[joint].p < kCertain) return false;
    float least = LongestBone(bone);
    for (const DepthLayer& layer : joint_layers_[joint]) {
      const Seed seed = JointAt(joint, layer.depth_m);
      const float length = (seed.p_camera - known.p_camera).norm();
      if (length > least) continue;
      least = length;
      joints_[joint] = seed;
    }
    return joints_[joint].has_value();
  }

  float LongestBone(std::size_t bone) const {
    return kBoneLengths[bone] * static_cast<float>(config_.max_bone_stretch) + kSurfaceNoise;
  }

  bool IsTooLong(std::size_t bone) const {
    const auto& from = joints_[kBones[bone].from];
    const auto& to = joints_[kBones[bone].to];
    if (!from || !to) return false;
    return (from->p_camera - to->p_camera).norm() > LongestBone(bone);
  }

  /// What the bones say of a joint.
  struct Fit {
    int too_long = 0;
    int fitting = 0;
  };

  std::array<Fit, kNumCocoJoints> FitOfBones() const {
    std::array<Fit, kNumCocoJoints> fits{};
    for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
      const auto [from, to] = kBones[bone];
      if (!joints_[from] || !joints_[to]) continue;
      for (const CocoJoint joint : {from, to}) {
        ++(IsTooLong(bone) ? fits[joint].too_long : fits[joint].fitting);
      }
    }
    return fits;
  }

  /// Drops joints until no bone is longer than a body's: first those with most bones too long, of
  /// these the one with fewest others, of these the one farthest from the depth of the body.
  void DropFarJoints() {
    for (;;) {
      const auto fits = FitOfBones();
      const auto badness = [&](std::size_t i) {
        return std::make_tuple(fits[i].too_long, -fits[i].fitting, DepthError(i));
      };
      std::size_t worst = kNumCocoJoints;
      for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
        if (fits[i].too_long == 0) continue;
        if (worst == kNumCocoJoints || badness(i) > badness(worst)) worst = i;
      }
      if (worst == kNumCocoJoints) return;
      joints_[worst].reset();
    }
  }

  float DepthError(std::size_t joint) const {
    return std::abs(joints_[joint]->p_camera.z() - result_.body_depth_m);
  }

  void TakeJoints() {
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      result_.found[i] = joints_[i].has_value();
      if (!joints_[i]) continue;
      result_.seeds.push_back(*joints_[i]);
      if (skeleton_[i].p >= kCertain) ++result_.num_certain_joints;
    }
    result_.num_joints = static_cast<int>(result_.seeds.size());
  }

  /// Seeds the surface at pixel (u, v) when it lies at depth z.
  void SeedNear(float u, float v, float z, float radius_share) {
    const auto depth =
        NearestLayer(layers_.At(u, v, kBoneWindow), z, static_cast<float>(config_.bone_depth_m));
    if (depth) result_.seeds.push_back(SeedAt(u, v, *depth, radius_share));
  }

  /// Point at share t of the line between two seeds, also beyond them; 1 / z is linear in the
  /// image.
  void SeedOnLine(const Seed& from, const Seed& to, float t) {
    const cv::Point2f pixel = from.pixel + t * (to.pixel - from.pixel);
    const float inverse = (1 - t) / from.p_camera.z() + t / to.p_camera.z();
    const float share =
        from.radius_share + std::min(t, 1.0F) * (to.radius_share - from.radius_share);
    if (inverse > 0) SeedNear(pixel.x, pixel.y, 1 / inverse, share);
  }

  void SeedBones() {
    for (const Bone& bone : kBones) {
      const auto& from = joints_[bone.from];
      const auto& to = joints_[bone.to];
      if (!from || !to) continue;
      const float length = (from->p_camera - to->p_camera).norm();
      const int steps =
          static_cast<int>(std::ceil(length / static_cast<float>(config_.bone_step_m)));
      for (int i = 1; i < steps; ++i) {
        SeedOnLine(*from, *to, static_cast<float>(i) / static_cast<float>(steps));
      }
    }
  }

  /// Beyond `to` on the line from `from`, in shares of the distance between them.
  void SeedBeyond(std::size_t from, std::size_t to, std::initializer_list<float> shares) {
    if (!joints_[from] || !joints_[to]) return;
    for (const float share : shares) SeedOnLine(*joints_[from], *joints_[to], 1 + share);
  }

  /// Half a hand beyond the wrist, the heel below the ankle, the skull above the face.
  void SeedExtremities() {
    SeedBeyond(kRightElbow, kRightWrist, {0.2F, 0.4F});
    SeedBeyond(kLeftElbow, kLeftWrist, {0.2F, 0.4F});
    SeedBeyond(kRightKnee, kRightAnkle, {0.12F});
    SeedBeyond(kLeftKnee, kLeftAnkle, {0.12F});
    if (joints_[kNose]) {
      SeedBeyond(kNeck, kNose, {0.3F, 0.6F});
    } else {
      SeedBeyond(kRightHip, kNeck, {0.15F, 0.3F, 0.45F});
      SeedBeyond(kLeftHip, kNeck, {0.15F, 0.3F, 0.45F});
    }
  }

  bool Has(CocoJoint joint) const { return joints_[joint].has_value(); }

  /// Whether a joint is so close to the border of the image that a limb of this length may leave
  /// it.
  bool IsAtBorder(const Seed& joint, float length_m) const {
    const float reach_px =
        kBorderShare * length_m * static_cast<float>(camera_.fx) / joint.p_camera.z();
    const float right = static_cast<float>(camera_.width) - reach_px;
    const float bottom = static_cast<float>(camera_.height) - reach_px;
    return joint.pixel.x < reach_px || joint.pixel.y < reach_px || joint.pixel.x > right ||
           joint.pixel.y > bottom;
  }

  /// Whatever hangs on `joint` may be within a limb's length when `next` was not found.
  void GuardLimb(CocoJoint joint, CocoJoint next, float length_m) {
    if (Has(joint) && !Has(next))
      result_.unseen_parts.push_back(
          {joints_[joint]->p_camera, length_m, IsAtBorder(*joints_[joint], length_m)});
  }

  void FindUnseenParts() {
    GuardLimb(kRightShoulder, kRightElbow, kUpperArm + kForearm);
    GuardLimb(kLeftShoulder, kLeftElbow, kUpperArm + kForearm);
    GuardLimb(kRightElbow, kRightWrist, kForearm);
    GuardLimb(kLeftElbow, kLeftWrist, kForearm);
    GuardLimb(kRightKnee, kRightAnkle, kLegLength / 2);
    GuardLimb(kLeftKnee, kLeftAnkle, kLegLength / 2);
    GuardLimb(kRightWrist, kRightElbow, kForearm);
    GuardLimb(kLeftWrist, kLeftElbow, kForearm);
    GuardLimb(kRightAnkle, kRightKnee, kLegLength / 2);
    GuardLimb(kLeftAnkle, kLeftKnee, kLegLength / 2);
    if (!Has(kNeck)) GuardLimb(kRightElbow, kRightShoulder, kTrunkLength);
    if (!Has(kNeck)) GuardLimb(kLeftElbow, kLeftShoulder, kTrunkLength);
    GuardLegs();
  }

  /// Places below the lowest joint, where legs are missing.
  void GuardLegs() {
    if (Has(kRightAnkle) || Has(kLeftAnkle)) return;
    float length_m = kTrunkLength + kLegLength;
    if (Has(kRightHip) || Has(kLeftHip)) length_m = kLegLength;
    if (Has(kRightKnee) || Has(kLeftKnee)) length_m = kLegLength / 2;
    const Seed* lowest = nullptr;
    for (const auto& joint : joints_) {
      if (!joint) continue;
      if (lowest == nullptr || joint->p_camera.dot(down_) > lowest->p_camera.dot(down_)) {
        lowest = &*joint;
      }
    }
    if (lowest == nullptr) return;
    for (float below_m = 0; below_m <= length_m; below_m += kGuardStep) {
      result_.unseen_parts.push_back({lowest->p_camera + below_m * down_, kTrunkHalfWidth});
    }
  }

  const Skeleton& skeleton_;
  const CameraModel& camera_;
  const SeedConfig& config_;
  const Eigen::Vector3f down_;  ///< unit vector
  DepthLayers layers_;
  std::array<std::vector<DepthLayer>, kNumCocoJoints> joint_layers_;
  std::array<std::optional<Seed>, kNumCocoJoints> joints_;
  PersonSeeds result_;
};

}  // namespace

PersonSeeds LiftPerson(const Skeleton& skeleton, const RgbdFrame& frame, const SeedConfig& config,
                       const std::optional<Eigen::Vector3f>& gravity) {
  return Lifting(skeleton, frame, config, gravity.value_or(Eigen::Vector3f::UnitY())).Run();
}

}  // namespace posefusion
