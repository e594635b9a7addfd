#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <posefusion/BlurScore.h>
#include <posefusion/HumanInfo.h>
#include <posefusion/SaveFile.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <filesystem>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/pipeline/slam_config.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/log_lines.h"
#include "test/ros/nodelet_graph.h"
#include "test/ros/recorder.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;

class Operation : public testing::Test {
 protected:
  void Start() {
    graph_.SetParam("/mapping/ros/output_dir", folder_.path());
    graph_.SetParam("/mapping/ros/human_removal", true);
    graph_.SetParam("/human_removal/max_start_wait_s", 0.0);  // nobody sends keypoints
    graph_.SetParam("/mapping/ros/input/no_data_warning_s", 1.0);
    ASSERT_TRUE(graph_.Start());
  }

  void SendFrames(int count) {
    ros::Time last;
    for (int i = 0; i < count; ++i) {
      const RgbdMessages frame = PairedMessages(next_++);
      last = frame.rgb->header.stamp;
      graph_.Publish(frame);
      ros::WallDuration(0.03).sleep();
    }
    EXPECT_TRUE(graph_.WaitFor([&](const Status& status) { return status.header.stamp == last; }));
    ros::WallDuration(0.3).sleep();
  }

  template <class Service>
  auto Call(const std::string& name, const typename Service::Request& request = {}) {
    Service service;
    service.request = request;
    EXPECT_TRUE(ros::service::waitForService(name, 5000)) << name;
    EXPECT_TRUE(ros::service::call(name, service)) << name;
    return service.response;
  }

  auto Save(const std::string& service, const std::string& name, bool overwrite = false) {
    SaveFile::Request request;
    request.name = name;
    request.overwrite = static_cast<std::uint8_t>(overwrite);
    return Call<SaveFile>(service, request);
  }

  auto Set(const std::string& name, bool value) {
    std_srvs::SetBool::Request request;
    request.data = static_cast<std::uint8_t>(value);
    return Call<std_srvs::SetBool>(name, request);
  }

  template <class Parameter, class Value>
  static Parameter Named(const std::string& name, const Value& value) {
    Parameter parameter;
    parameter.name = name;
    parameter.value = value;
    return parameter;
  }
  auto SetDouble(const std::string& nodelet, const std::string& name, double value) {
    dynamic_reconfigure::Reconfigure::Request request;
    request.config.doubles.push_back(Named<dynamic_reconfigure::DoubleParameter>(name, value));
    return Call<dynamic_reconfigure::Reconfigure>(nodelet + "/set_parameters", request).config;
  }
  static double DoubleOf(const dynamic_reconfigure::Config& config, const std::string& name) {
    for (const auto& parameter : config.doubles) {
      if (parameter.name == name) return parameter.value;
    }
    return NAN;
  }

  TemporaryFolder folder_;
  NodeletGraph graph_;
  int next_ = 0;
};

TEST_F(Operation, SavesIntoTheOutputFolderAndNowhereElse) {
  Start();
  EXPECT_THAT(Save("/mapping/save_ply", "map.ply").message, HasSubstr("the map is empty"));
  EXPECT_THAT(Save("/mapping/save_trajectory", "t.txt").message, HasSubstr("no pose yet"));
  SendFrames(10);

  const auto saved = Save("/mapping/save_ply", "now.ply");
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "now.ply"));
  EXPECT_TRUE(Save("/mapping/save_trajectory", "now.txt").success);
  EXPECT_EQ(ReadTrajectory(folder_ / "now.txt").size(), graph_.status().frames_tracked);

  EXPECT_THAT(Save("/mapping/save_ply", "now.ply").message, HasSubstr("exists"));
  EXPECT_TRUE(Save("/mapping/save_ply", "now.ply", true).success);
  for (const char* name : {"/tmp/away.ply", "../away.ply", "", "a/../../away.ply"}) {
    EXPECT_FALSE(Save("/mapping/save_ply", name, true).success) << name;
    EXPECT_FALSE(Save("/mapping/save_trajectory", name, true).success) << name;
  }
  std::filesystem::create_symlink("/tmp", folder_ / "link");
  EXPECT_THAT(Save("/mapping/save_ply", "link/away.ply", true).message, HasSubstr("leads out"));
  SendFrames(2);
  EXPECT_EQ(graph_.status().state, "tracking") << "nothing of it stops the mapping";
}

TEST_F(Operation, WithoutAnOutputFolderNothingIsSaved) {
  ASSERT_TRUE(graph_.Start());
  EXPECT_THAT(Save("/mapping/save_ply", "map.ply").message, HasSubstr("ros/output_dir is empty"));
}

TEST_F(Operation, ResetForgetsTheMapAndGoesOn) {
  Start();
  EXPECT_TRUE(Call<std_srvs::Trigger>("/mapping/reset").success) << "also with nothing to forget";
  SendFrames(5);
  EXPECT_TRUE(Call<std_srvs::Trigger>("/mapping/reset").success);
  SendFrames(3);
  EXPECT_EQ(graph_.status().resets, 2U);
  EXPECT_LE(graph_.status().frames_processed, 3U);
  EXPECT_EQ(graph_.status().state, "tracking");
}

TEST_F(Operation, PauseThrowsFramesAwayUntilItEnds) {
  Start();
  SendFrames(3);
  EXPECT_THAT(Set("/mapping/pause", false).message, HasSubstr("was not paused"));
  EXPECT_TRUE(Set("/mapping/pause", true).success);
  EXPECT_THAT(Set("/mapping/pause", true).message, HasSubstr("was paused already"));
  const auto before = graph_.status().frames_processed;
  for (int i = 0; i < 5; ++i) graph_.Publish(PairedMessages(next_++));
  EXPECT_TRUE(graph_.WaitFor([](const Status& status) { return status.state == "paused"; }));
  EXPECT_EQ(graph_.status().frames_processed, before);
  EXPECT_TRUE(Call<std_srvs::Trigger>("/mapping/reset").success) << "services go on";
  Set("/mapping/pause", false);
  SendFrames(2);
  EXPECT_EQ(graph_.status().state, "tracking");
}

TEST_F(Operation, HumanRemovalIsSwitchedWhileItRuns) {
  Start();
  const Recorder<HumanInfo> info(kStaticInfoTopic);
  SendFrames(3);
  ASSERT_TRUE(info.WaitForSize(3));
  EXPECT_TRUE(info.messages().back()->removal_enabled);
  EXPECT_TRUE(Set("/human_removal/set_human_removal", false).success);
  SendFrames(3);
  EXPECT_FALSE(info.messages().back()->removal_enabled);
  EXPECT_EQ(graph_.status().human_removal, 0);
  EXPECT_THAT(Set("/human_removal/set_human_removal", false).message, HasSubstr("as before"));
  EXPECT_TRUE(Set("/human_removal/set_human_removal", true).success);
  SendFrames(3);
  EXPECT_TRUE(info.messages().back()->removal_enabled);
  EXPECT_EQ(graph_.status().human_removal, 1);
}

TEST_F(Operation, ParametersChangeWhileItRunsAndOutOfRangeOnesDoNot) {
  Start();
  const LogLines log;
  SendFrames(2);
  EXPECT_EQ(DoubleOf(SetDouble("/mapping", "pyramid_max_depth_m", 3.5), "pyramid_max_depth_m"),
            3.5);
  EXPECT_EQ(DoubleOf(SetDouble("/mapping", "pyramid_max_depth_m", -1), "pyramid_max_depth_m"), 3.5);
  EXPECT_EQ(DoubleOf(SetDouble("/mapping", "no_such_key", 1), "pyramid_max_depth_m"), 3.5);
  EXPECT_TRUE(log.WaitFor({"nothing is changed: /mapping.pyramid.max_depth_m"}, 5));
  double on_server = 0;
  EXPECT_TRUE(ros::param::get("/mapping/pyramid/max_depth_m", on_server));
  EXPECT_EQ(on_server, 3.5);

  EXPECT_EQ(DoubleOf(SetDouble("/human_removal", "min_cut_sigma_m", 0.3), "min_cut_sigma_m"), 0.3);
  EXPECT_EQ(DoubleOf(SetDouble("/human_removal", "min_cut_sigma_m", 99), "min_cut_sigma_m"), 0.3);

  const Recorder<BlurScore> score(kBlurScoreTopic);
  EXPECT_EQ(DoubleOf(SetDouble("/blur_filter", "max_length_px", 2.5), "max_length_px"), 2.5);
  EXPECT_EQ(DoubleOf(SetDouble("/blur_filter", "max_length_px", -5), "max_length_px"), 2.5);
  SendFrames(2);
  EXPECT_EQ(score.messages().back()->threshold, 2.5);
  EXPECT_EQ(graph_.status().state, "tracking");
}

TEST_F(Operation, DescriptionsHaveTheDefaultsOfTheConfigStructs) {
  graph_.SetParam("/mapping/pyramid/max_depth_m", 2.25);
  Start();
  const Recorder<dynamic_reconfigure::ConfigDescription> description(
      "/mapping/parameter_descriptions");
  const Recorder<dynamic_reconfigure::Config> updates("/mapping/parameter_updates");
  ASSERT_TRUE(description.WaitForSize(1) && updates.WaitForSize(1));
  EXPECT_EQ(DoubleOf(description.messages()[0]->dflt, "pyramid_max_depth_m"),
            PyramidConfig().max_depth_m);
  EXPECT_EQ(DoubleOf(*updates.messages()[0], "pyramid_max_depth_m"), 2.25);
}

/// The newest entry of that name.
diagnostic_msgs::DiagnosticStatus Newest(
    const Recorder<diagnostic_msgs::DiagnosticArray>& diagnostics, const std::string& name) {
  diagnostic_msgs::DiagnosticStatus found;
  for (const auto& array : diagnostics.messages()) {
    for (const auto& status : array->status) {
      if (status.name == name) found = status;
    }
  }
  return found;
}

std::vector<std::string> KeysOf(const diagnostic_msgs::DiagnosticStatus& status) {
  std::vector<std::string> keys;
  for (const auto& value : status.values) keys.push_back(value.key);
  return keys;
}

TEST_F(Operation, DiagnosticsHaveWhatAnOperatorNeeds) {
  const Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Start();
  for (int i = 0; i < 3; ++i) SendFrames(15);
  const auto keys = [&](const std::string& name) { return KeysOf(Newest(diagnostics, name)); };
  EXPECT_THAT(keys("mapping: topics"), Contains("/sharp/rgb/image_rect_color"));
  EXPECT_THAT(keys("mapping: frames"),
              IsSupersetOf({"rate [Hz]", "delay from image to pose, median [s]",
                            "delay from image to pose, 95 % [s]", "waiting",
                            "dropped because newer ones waited", "refused", "resets"}));
  EXPECT_THAT(keys("mapping: tracking"),
              IsSupersetOf({"health", "lost", "times lost", "times found again", "surfels"}));
  EXPECT_THAT(keys("mapping: people"), IsSupersetOf({"people", "age of the mask [s]"}));
  EXPECT_THAT(keys("mapping: stages"), IsSupersetOf({"track [ms]", "fuse [ms]"}));
  EXPECT_EQ(Newest(diagnostics, "mapping: tf").level, diagnostic_msgs::DiagnosticStatus::OK);
}

TEST_F(Operation, DiagnosticsNameTheTopicThatIsSilent) {
  const Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Start();
  const auto newest = [&](const std::string& name) { return Newest(diagnostics, name); };
  ros::WallDuration(2.5).sleep();
  EXPECT_THAT(newest("blur_filter: topics").message,
              HasSubstr("no data on /camera/rgb/image_rect_color (nothing ever came)"));
  EXPECT_EQ(newest("blur_filter: topics").level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_THAT(newest("mapping: frames").message, HasSubstr("no frame has come"));
  for (int i = 0; i < 3; ++i) SendFrames(15);
  EXPECT_EQ(newest("mapping: topics").level, diagnostic_msgs::DiagnosticStatus::OK)
      << newest("mapping: topics").message;
  EXPECT_EQ(newest("mapping: tracking").level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_FALSE(newest("mapping: stages").values.empty());
  EXPECT_GT(graph_.status().rate_hz, 1);
  EXPECT_NE(newest("human_removal: people").name, "");
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  ros::init(argc, argv, "operation_test");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
