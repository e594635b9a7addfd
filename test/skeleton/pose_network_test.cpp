#include "posefusion/skeleton/pose_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "test/skeleton/tiny_caffe_network.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using testing::TinyCaffeNetwork;

constexpr int kSize = 64;        ///< of the tiny network's input
constexpr int kCell = 8;         ///< pixels per pixel of its maps
constexpr int kFirstField = 19;  ///< behind the heat maps

/// Sees a neck where it is red, a right shoulder where green, a left shoulder where blue;
/// everywhere the affinity fields point from the neck to the left for the one and to the right for
/// the other.
TinyCaffeNetwork ColourNetwork() {
  TinyCaffeNetwork network(57);
  network.channels[kNeck].third = 1;
  network.channels[kRightShoulder].second = 1;
  network.channels[kLeftShoulder].first = 1;
  network.channels[kFirstField + 12].bias = -1;
  network.channels[kFirstField + 20].bias = 1;
  return network;
}

/// Files of a tiny network in a folder of the test, and the parameters to use them.
struct TinyFiles {
  explicit TinyFiles(const TinyCaffeNetwork& network) {
    config.model = folder / "tiny.caffemodel";
    config.model_config = folder / "tiny.prototxt";
    config.input_width_px = config.input_height_px = kSize;
    config.grouping.min_joints = 3;
    network.Write(config.model_config, config.model);
  }

  TemporaryFolder folder;
  PoseNetworkConfig config;
};

void PaintCell(int x, int y, const cv::Scalar& rgb, cv::Mat& image) {
  const int cell = kCell * image.cols / kSize;
  cv::rectangle(image, cv::Rect(x * cell, y * cell, cell, cell), rgb, cv::FILLED);
}

/// Green, red and blue cells in a row, of brightness 204 = 0.8 * 255.
cv::Mat ThreeCells(int width_px, int height_px) {
  cv::Mat rgb = cv::Mat::zeros(height_px, width_px, CV_8UC3);
  PaintCell(1, 3, {0, 204, 0}, rgb);
  PaintCell(3, 3, {204, 0, 0}, rgb);
  PaintCell(5, 3, {0, 0, 204}, rgb);
  return rgb;
}

void ExpectJoint(const Joint& joint, double u, double v) {
  EXPECT_NEAR(joint.u, u, 1e-3);
  EXPECT_NEAR(joint.v, v, 1e-3);
  EXPECT_NEAR(joint.p, 0.8, 1e-3);
}

TEST(PoseNetwork, OpenPoseGetsBlueGreenRedFrom0To1) {
  const TinyFiles files(ColourNetwork());
  PoseNetwork network(files.config);
  const auto people = network.Detect(ThreeCells(kSize, kSize));
  ASSERT_EQ(people.size(), 1U);
  ExpectJoint(people[0][kRightShoulder], 1.5 * kCell - 0.5, 3.5 * kCell - 0.5);
  ExpectJoint(people[0][kNeck], 3.5 * kCell - 0.5, 3.5 * kCell - 0.5);
  ExpectJoint(people[0][kLeftShoulder], 5.5 * kCell - 0.5, 3.5 * kCell - 0.5);
}

TEST(PoseNetwork, JointsLieInThePixelsOfTheImageAsItCame) {
  const TinyFiles files(ColourNetwork());
  PoseNetwork network(files.config);
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(128, 128), cv::Size(256, 128)}) {
    const auto people = network.Detect(ThreeCells(size.width, size.height));
    const double cell = kCell * size.width / static_cast<double>(kSize);
    ASSERT_EQ(people.size(), 1U) << size;
    ExpectJoint(people[0][kNeck], 3.5 * cell - 0.5, 3.5 * cell - 0.5);
  }
}

TEST(PoseNetwork, NobodyInABlackPicture) {
  const TinyFiles files(ColourNetwork());
  EXPECT_TRUE(PoseNetwork(files.config).Detect(cv::Mat::zeros(48, 64, CV_8UC3)).empty());
}

TEST(PoseNetwork, RefusesImagesOfAnotherType) {
  const TinyFiles files(ColourNetwork());
  PoseNetwork network(files.config);
  EXPECT_THAT([&] { network.Detect(cv::Mat::zeros(48, 64, CV_8UC1)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("8UC1")));
  EXPECT_THAT([&] { network.Detect(cv::Mat()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("empty")));
}

/// Expects that loading fails for that key, with all of `parts` in the message.
void ExpectRefused(const PoseNetworkConfig& config, const std::string& key,
                   const std::string& part) {
  EXPECT_THAT([&] { PoseNetwork network(config); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("pose_network." + key), HasSubstr(part))));
}

TEST(PoseNetworkFile, MissingOnesAreNamedWithTheirKey) {
  TinyFiles files(ColourNetwork());
  PoseNetworkConfig no_model = files.config;
  no_model.model = "/nowhere/pose.caffemodel";
  ExpectRefused(no_model, "model:", "/nowhere/pose.caffemodel does not exist");
  PoseNetworkConfig no_description = files.config;
  no_description.model_config = "/nowhere/pose.prototxt";
  ExpectRefused(no_description, "model_config:", "/nowhere/pose.prototxt does not exist");
  PoseNetworkConfig folder = files.config;
  folder.model = files.folder.path();
  ExpectRefused(folder, "model:", files.folder.path() + " is no file");
  ExpectRefused(PoseNetworkConfig(), "model:", "is empty");
}

TEST(PoseNetworkFile, WeightsWithoutTheirDescriptionSayWhatIsNeeded) {
  TinyFiles files(ColourNetwork());
  files.config.model_config.clear();
  ExpectRefused(files.config, "model_config:", ".prototxt of " + files.config.model);
}

TEST(PoseNetworkFile, OnesOfAnotherKindAreNamed) {
  const TinyFiles files(ColourNetwork());
  PoseNetworkConfig graph;
  graph.model = files.folder / "graph.pb";
  for (const char* contents : {"", "neither a graph nor anything else", "\xff\xd8\xff\xe0JFIF"}) {
    WriteFileAtomically(graph.model, contents);
    ExpectRefused(graph, "model:", graph.model + " is no TensorFlow graph");
  }
  PoseNetworkConfig weights = files.config;
  weights.model = files.folder / "graph.pb";
  ExpectRefused(weights, "model:", weights.model);
  PoseNetworkConfig description = files.config;
  description.model_config = files.folder / "text.prototxt";
  WriteFileAtomically(description.model_config, "layers of onions {");
  ExpectRefused(description, "model_config:", description.model_config + " is no caffe network");
}

TEST(PoseNetworkFile, NetworkOfAnotherBodyModelIsNamedWithItsOutputs) {
  const TinyFiles body_25(TinyCaffeNetwork(78));
  ExpectRefused(body_25.config, "model:", "gives 1 x 78 x 8 x 8 values");
}

TEST(PoseNetworkFile, InputSizesBesideTheStrideAreRefused) {
  TinyFiles files(ColourNetwork());
  files.config.input_height_px = 100;
  ExpectRefused(files.config, "input_height_px", "multiple of 8");
}

}  // namespace
}  // namespace posefusion
