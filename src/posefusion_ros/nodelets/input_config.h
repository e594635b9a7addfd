#pragma once

namespace posefusion {

/// How a nodelet takes in colour, depth and camera_info.
struct InputConfig {
  double max_stamp_difference_s = 0.02;  ///< between colour and depth of a frame
  double flush_after_s = 1.0;            ///< silence after which what waits is paired as it is
  double no_data_warning_s = 5.0;        ///< silence after which the missing topic is named
  /// Images that may wait while the nodelet is busy, per topic; older ones are dropped.
  int subscriber_queue_size = 10;
  bool lossless = false;  ///< let everything wait instead (playing a bag, not a robot)
};

template <class V>
void Describe(V& v, InputConfig& c) {
  v.Field("max_stamp_difference_s", c.max_stamp_difference_s, 1e-6, 1.0);
  v.Field("flush_after_s", c.flush_after_s, 0.05, 60.0);
  v.Field("no_data_warning_s", c.no_data_warning_s, 0.1, 3600.0);
  v.Field("subscriber_queue_size", c.subscriber_queue_size, 1, 1000);
  v.Field("lossless", c.lossless);
}

}  // namespace posefusion
