#include "posefusion/simulation/body.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

double ShortTurn(double from, double to) { return std::remainder(to - from, 2 * M_PI); }

LimbAngles Blend(const LimbAngles& a, const LimbAngles& b, double share) {
  const auto mix = [share](double from, double to) { return from + (to - from) * share; };
  return {mix(a.hip, b.hip),
          mix(a.hip_out, b.hip_out),
          mix(a.knee, b.knee),
          mix(a.shoulder, b.shoulder),
          mix(a.shoulder_out, b.shoulder_out),
          mix(a.shoulder_in, b.shoulder_in),
          mix(a.elbow, b.elbow)};
}

Isometry3d Pitch(double angle) { return Isometry3d(AngleAxisd(angle, Vector3d::UnitY())); }
Isometry3d Roll(double angle) { return Isometry3d(AngleAxisd(angle, Vector3d::UnitX())); }
Isometry3d Yaw(double angle) { return Isometry3d(AngleAxisd(angle, Vector3d::UnitZ())); }
Isometry3d Shift(double x, double y, double z) { return Isometry3d(Translation3d(x, y, z)); }

/// Parts of one leg; `side` is +1 for the left one.
struct Leg {
  Isometry3d thigh, shank, foot;
};

Leg PoseLeg(const BodyShape& s, const Isometry3d& T_map_pelvis, const LimbAngles& a, double side) {
  Leg leg;
  leg.thigh =
      T_map_pelvis * Shift(0, side * s.hip_half, 0) * Roll(side * a.hip_out) * Pitch(-a.hip);
  leg.shank = leg.thigh * Shift(0, 0, -s.thigh) * Pitch(a.knee);
  const double level = 0.75 * (a.hip - a.knee);  // the foot turns back towards the floor
  leg.foot = leg.shank * Shift(0, 0, -s.shank) * Pitch(level);
  return leg;
}

/// Lowest point of a foot's sole.
double SoleHeight(const BodyShape& s, const Isometry3d& T_map_foot) {
  const Vector3d heel = T_map_foot * Vector3d(-0.25 * s.foot_length, 0, -s.foot_height);
  const Vector3d toe = T_map_foot * Vector3d(0.75 * s.foot_length, 0, -s.foot_height);
  return std::min(heel.z(), toe.z());
}

void PlaceLeg(const BodyShape& s, const Leg& leg, bool left, PersonPose& pose) {
  pose.T_map_part[left ? kLeftThigh : kRightThigh] = leg.thigh;
  pose.T_map_part[left ? kLeftShank : kRightShank] = leg.shank;
  pose.T_map_part[left ? kLeftFoot : kRightFoot] = leg.foot;
  pose.joints[left ? kLeftHip : kRightHip] = leg.thigh.translation();
  pose.joints[left ? kLeftKnee : kRightKnee] = leg.shank.translation();
  pose.joints[left ? kLeftAnkle : kRightAnkle] = leg.foot.translation();
  const auto bone = [&](BodyPart part, const Vector3d& end, double radius) {
    const Isometry3d& T = pose.T_map_part[part];
    pose.capsules[part] = {T.translation(), T * end, radius * s.girth};
  };
  bone(left ? kLeftThigh : kRightThigh, {0, 0, -s.thigh}, 0.085);
  bone(left ? kLeftShank : kRightShank, {0, 0, -s.shank}, 0.06);
  bone(left ? kLeftFoot : kRightFoot, {0.6 * s.foot_length, 0, -s.foot_height / 2}, 0.055);
}

void PlaceArm(const BodyShape& s, const Isometry3d& T_map_chest, const LimbAngles& a, bool left,
              PersonPose& pose) {
  const double side = left ? 1 : -1;
  const Isometry3d upper = T_map_chest * Shift(0, side * s.shoulder_half, 0.73 * s.trunk) *
                           Roll(side * a.shoulder_out) * Pitch(-a.shoulder) *
                           Yaw(-side * a.shoulder_in);
  const Isometry3d fore = upper * Shift(0, 0, -s.upper_arm) * Pitch(-a.elbow);
  const Isometry3d hand = fore * Shift(0, 0, -s.forearm);
  pose.T_map_part[left ? kLeftUpperArm : kRightUpperArm] = upper;
  pose.T_map_part[left ? kLeftForearm : kRightForearm] = fore;
  pose.T_map_part[left ? kLeftHand : kRightHand] = hand;
  pose.joints[left ? kLeftShoulder : kRightShoulder] = upper.translation();
  pose.joints[left ? kLeftElbow : kRightElbow] = fore.translation();
  pose.joints[left ? kLeftWrist : kRightWrist] = hand.translation();
  const auto bone = [&](BodyPart part, double length, double radius) {
    const Isometry3d& T = pose.T_map_part[part];
    pose.capsules[part] = {T.translation(), T * Vector3d(0, 0, -length), radius * s.girth};
  };
  bone(left ? kLeftUpperArm : kRightUpperArm, s.upper_arm, 0.055);
  bone(left ? kLeftForearm : kRightForearm, s.forearm, 0.045);
  bone(left ? kLeftHand : kRightHand, s.hand, 0.05);
}

void PlaceHead(const BodyShape& s, const Posture& p, PersonPose& pose) {
  const Isometry3d neck =
      pose.T_map_part[kChest] * Shift(0.0, 0, 0.8 * s.trunk) * Pitch(-0.3 * p.lean);
  const Isometry3d head = neck * Shift(0.012, 0, s.neck) * Yaw(p.head_yaw) * Pitch(p.head_pitch);
  pose.T_map_part[kNeckPart] = neck;
  pose.T_map_part[kHead] = head;
  pose.joints[kNeck] = neck.translation();
  const double r = 0.36 * s.head;
  pose.joints[kNose] = head * Vector3d(1.15 * r, 0, 0.36 * s.head);
  for (const double side : {-1.0, 1.0}) {
    pose.joints[side > 0 ? kLeftEye : kRightEye] = head * Vector3d(r, side * 0.4 * r, 0.5 * s.head);
    pose.joints[side > 0 ? kLeftEar : kRightEar] = head * Vector3d(0, side * r, 0.42 * s.head);
  }
  pose.capsules[kNeckPart] = {neck.translation(), head.translation(), 0.06};
  pose.capsules[kHead] = {head * Vector3d(0, 0, 0.4 * s.head), head * Vector3d(0, 0, 0.6 * s.head),
                          0.125};
}

}  // namespace

Posture Blend(const Posture& a, const Posture& b, double share) {
  Posture p;
  const auto mix = [share](double from, double to) { return from + (to - from) * share; };
  p.floor = a.floor + (b.floor - a.floor) * share;
  p.yaw = a.yaw + ShortTurn(a.yaw, b.yaw) * share;
  p.lean = mix(a.lean, b.lean);
  p.sway = mix(a.sway, b.sway);
  p.twist = mix(a.twist, b.twist);
  p.head_yaw = mix(a.head_yaw, b.head_yaw);
  p.head_pitch = mix(a.head_pitch, b.head_pitch);
  p.right = Blend(a.right, b.right, share);
  p.left = Blend(a.left, b.left, share);
  return p;
}

PersonPose PoseBody(const BodyShape& s, const Posture& p) {
  PersonPose pose;
  pose.present = true;
  Isometry3d pelvis = Shift(p.floor.x(), p.floor.y(), 0) * Yaw(p.yaw);
  const double drop = std::min(SoleHeight(s, PoseLeg(s, pelvis, p.right, -1).foot),
                               SoleHeight(s, PoseLeg(s, pelvis, p.left, 1).foot));
  pelvis = Shift(0, 0, -drop) * pelvis;
  PlaceLeg(s, PoseLeg(s, pelvis, p.right, -1), false, pose);
  PlaceLeg(s, PoseLeg(s, pelvis, p.left, 1), true, pose);
  pose.T_map_part[kPelvis] = pelvis * Pitch(0.5 * p.lean) * Roll(-0.5 * p.sway);
  pose.T_map_part[kChest] = pose.T_map_part[kPelvis] * Shift(0, 0, 0.2 * s.trunk) *
                            Pitch(0.5 * p.lean) * Roll(-0.5 * p.sway) * Yaw(p.twist);
  const Isometry3d& chest = pose.T_map_part[kChest];
  pose.capsules[kPelvis] = {pelvis.translation(), chest.translation(), 0.16 * s.girth};
  pose.capsules[kChest] = {chest * Vector3d(0, 0, 0.1), chest * Vector3d(0, 0, 0.65 * s.trunk),
                           0.19 * s.girth};
  PlaceArm(s, chest, p.right, false, pose);
  PlaceArm(s, chest, p.left, true, pose);
  PlaceHead(s, p, pose);
  return pose;
}

}  // namespace posefusion
