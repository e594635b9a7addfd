#include "posefusion_ros/bag_writer.h"

#include <rosbag/bag.h>

#include <filesystem>
#include <stdexcept>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
struct BagWriter::State {
  std::string path;
  std::string temporary_path;
  std::string camera_frame;
  std::unique_ptr<rosbag::Bag> bag = std::make_unique<rosbag::Bag>();
  bool complete = false;

  /// Removes what is not complete.
  ~State() {
    if (complete) return;
    try {
      bag->close();
    } catch (const std::exception&) {
      // On a full disk the bag's own destructor would throw once more and end the program.
      static_cast<void>(bag.release());
    }
    std::error_code ignored;
    std::filesystem::remove(temporary_path, ignored);
  }

  /// Runs a step of writing; its errors name the bag.
  template <class Step>
  void Guarded(const Step& step) {
    try {
      step();
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ": cannot be written: " + error.what());
    }
  }
};

BagWriter::BagWriter(const std::string& path, const std::string& camera_frame)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->temporary_path = path + ".tmp";
  state_->camera_frame = camera_frame;
  state_->Guarded([&] { state_->bag->open(state_->temporary_path, rosbag::bagmode::Write); });
}

BagWriter::~BagWriter() = default;

void BagWriter::Write(const RgbdFrame& frame) {
  std_msgs::Header header;
  header.frame_id = state_->camera_frame;
  header.stamp = ToRosTime(frame.depth_stamp_ns);
  state_->Guarded([&] {
    const auto write = [&](const char* topic, const auto& message) {
      state_->bag->write(std::string("/") + topic, message.header.stamp, message);
    };
    write(kCameraDepthTopic, *ToDepthMessage(frame.depth_m, header));
    header.stamp = ToRosTime(frame.stamp_ns);
    write(kCameraInfoTopic, ToCameraInfo(frame.camera, header));
    write(kCameraRgbTopic, *ToRgb8Message(frame.rgb, header));
  });
}

void BagWriter::Write(const Skeletons& skeletons) {
  std_msgs::Header header;
  header.frame_id = state_->camera_frame;
  header.stamp = ToRosTime(skeletons.stamp_ns);
  state_->Guarded([&] {
    state_->bag->write(std::string("/") + kSkeletonsInTopic, ToRosTime(skeletons.arrival_ns),
                       ToSkeletonsMessage(skeletons, header));
  });
}

void BagWriter::WriteOther(const std::function<void(rosbag::Bag&)>& write) {
  state_->Guarded([&] { write(*state_->bag); });
}

void BagWriter::Close() {
  state_->Guarded([&] {
    state_->bag->close();
    std::filesystem::rename(state_->temporary_path, state_->path);
  });
  state_->complete = true;
}

}  // namespace posefusion
