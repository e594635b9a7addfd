#pragma once

namespace posefusion {

struct PartGroupingConfig {
  double peak_threshold = 0.08;   ///< a joint is a local maximum of its heat map above this
  double field_threshold = 0.05;  ///< a limb's field agrees where its component along it is above
  double min_agreement = 0.8;     ///< share of a limb's samples where the field has to agree
  int limb_samples = 10;          ///< points on a limb at which the field is sampled
  int min_joints = 4;             ///< a person has so many at least
  double min_confidence = 0.2;    ///< of a person: mean of the joints
};

template <class V>
void Describe(V& v, PartGroupingConfig& c) {
  v.Field("peak_threshold", c.peak_threshold, 0.01, 1.0);
  v.Field("field_threshold", c.field_threshold, 0.0, 1.0);
  v.Field("min_agreement", c.min_agreement, 0.0, 1.0);
  v.Field("limb_samples", c.limb_samples, 2, 100);
  v.Field("min_joints", c.min_joints, 1, 18);
  v.Field("min_confidence", c.min_confidence, 0.0, 1.0);
}

}  // namespace posefusion
