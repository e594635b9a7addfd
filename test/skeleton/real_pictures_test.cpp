// A small real network on real pictures of people. Pictures and network are not in the repository.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/dataset/image_file.h"
#include "posefusion/skeleton/openpose_json.h"
#include "posefusion/skeleton/pose_network.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

const char* const kModel = "../models/tfpose_mobilenet_v2_small_cv_432x368.pb";
const char* const kSmallModel = "../models/tfpose_mobilenet_v2_small_cv_320x240.pb";

PoseNetworkConfig ModelConfig(int num_threads = 2) {
  PoseNetworkConfig config;
  config.model = DataPath(kModel);
  config.num_threads = num_threads;
  return config;
}

std::vector<Skeleton> DetectIn(PoseNetwork& network, const std::string& picture) {
  return network.Detect(ReadColourImage(DataPath(picture)));
}

std::vector<std::string> PicturesOf(const std::string& sequence) {
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(DataPath(sequence + "/rgb"))) {
    pictures.push_back(entry.path().string());
  }
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

/// Mask of a picture, 255 = person, grown by what joints of a coarse network may lie beside it;
/// outside of the image there is nobody.
cv::Mat GrownMask(const fs::path& picture) {
  constexpr int kGrowth_px = 5;
  const fs::path path =
      picture.parent_path().parent_path() / "masks" / (picture.stem().string() + ".png");
  cv::Mat mask = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  EXPECT_FALSE(mask.empty()) << path;
  cv::dilate(mask, mask, cv::Mat::ones(2 * kGrowth_px + 1, 2 * kGrowth_px + 1, CV_8U));
  return mask;
}

int NumJoints(const Skeleton& person) {
  return static_cast<int>(
      std::count_if(person.begin(), person.end(), [](const Joint& joint) { return joint.p > 0; }));
}

int NumJointsIn(const Skeleton& person, const cv::Mat& mask) {
  const cv::Rect image({}, mask.size());
  return static_cast<int>(std::count_if(person.begin(), person.end(), [&](const Joint& joint) {
    const cv::Point pixel(cvRound(joint.u), cvRound(joint.v));
    return joint.p > 0 && image.contains(pixel) && mask.at<uchar>(pixel) > 0;
  }));
}

/// How joints and people's masks of a sequence agree.
struct MaskAgreement {
  int joints = 0;
  int joints_in_masks = 0;
  int pictures_with_person = 0;
  int people_found = 0;  ///< pictures in which somebody with three joints or more in the mask is
};

MaskAgreement CompareWithMasks(const std::string& sequence) {
  constexpr int kVisiblePerson_px = 2000;
  PoseNetwork network(ModelConfig());
  MaskAgreement agreement;
  for (const std::string& picture : PicturesOf(sequence)) {
    const cv::Mat mask = GrownMask(picture);
    bool found = false;
    for (const Skeleton& person : network.Detect(ReadColourImage(picture))) {
      const int inside = NumJointsIn(person, mask);
      agreement.joints += NumJoints(person);
      agreement.joints_in_masks += inside;
      found |= inside >= 3;
    }
    if (cv::countNonZero(mask) < kVisiblePerson_px) continue;
    ++agreement.pictures_with_person;
    if (found) ++agreement.people_found;
  }
  return agreement;
}

TEST(RealPictures, PeopleAreFoundAndCountedRight) {
  SKIP_WITHOUT_DATA(kModel);
  PoseNetwork network(ModelConfig());
  EXPECT_EQ(DetectIn(network, "../models/test_p1.jpg").size(), 1U);
  EXPECT_EQ(DetectIn(network, "../models/test_p2.jpg").size(), 2U);
  for (const auto& [folder, count] :
       {std::pair("joint_vo_sf_cleaning_whiteboard", 1U), std::pair("joint_vo_sf_opening_door", 1U),
        std::pair("joint_vo_sf_person_standing", 1U),
        std::pair("joint_vo_sf_two_people_moving", 2U),
        std::pair("joint_vo_sf_two_people_walking", 2U), std::pair("ros_openpose_rgbd", 2U),
        std::pair("uva_turning", 1U)}) {
    for (const std::string& picture : PicturesOf(std::string("people_pictures/") + folder)) {
      EXPECT_EQ(network.Detect(ReadColourImage(picture)).size(), count) << picture;
    }
  }
}

TEST(RealPictures, EveryJointOfAPersonInFullViewIsFound) {
  SKIP_WITHOUT_DATA(kModel);
  PoseNetwork network(ModelConfig());
  const auto people = DetectIn(network, "../models/test_p1.jpg");
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(NumJoints(people[0]), kNumCocoJoints);
  EXPECT_LT(people[0][kNose].v, people[0][kNeck].v);
  EXPECT_LT(people[0][kNeck].v, people[0][kRightHip].v);
  EXPECT_LT(people[0][kRightHip].v, people[0][kRightKnee].v);
}

TEST(RealPictures, JointsOfATurningManLieOnHim) {
  SKIP_WITHOUT_DATA(kModel);
  const MaskAgreement agreement = CompareWithMasks("people_pictures/uva_turning");
  EXPECT_GE(agreement.joints, 35);
  EXPECT_GE(agreement.joints_in_masks, 0.95 * agreement.joints);
  EXPECT_EQ(agreement.people_found, 5);
}

TEST(RealPictures, JointsOfPeopleWhoLeaveThePictureStayInIt) {
  SKIP_WITHOUT_DATA(kModel);
  PoseNetwork network(ModelConfig());
  for (const std::string& picture : PicturesOf("people_pictures/ros_openpose_rgbd")) {
    const cv::Mat rgb = ReadColourImage(picture);
    const cv::Mat everywhere(rgb.size(), CV_8UC1, cv::Scalar::all(255));
    for (const Skeleton& person : network.Detect(rgb)) {
      EXPECT_EQ(NumJointsIn(person, everywhere), NumJoints(person)) << picture;
    }
  }
}

// Far people have no mask there, and the floor or a chair is taken for somebody now and then.
TEST(RealPictures, PeopleInACorridorAreFoundWithJointsOnThem) {
  SKIP_WITHOUT_DATA(kModel);
  const MaskAgreement agreement = CompareWithMasks("ist_corridor");
  EXPECT_GE(agreement.joints, 550);
  EXPECT_GE(agreement.joints_in_masks, 0.75 * agreement.joints);
  EXPECT_GE(agreement.people_found, 0.75 * agreement.pictures_with_person);
}

TEST(RealPictures, SameBytesAgainAndWithAnyNumberOfThreads) {
  SKIP_WITHOUT_DATA(kModel);
  const auto texts = [](int num_threads) {
    PoseNetwork network(ModelConfig(num_threads));
    std::vector<std::string> result;
    for (const std::string& picture : PicturesOf("people_pictures/ros_openpose_rgbd")) {
      result.push_back(ToOpenPoseJson(network.Detect(ReadColourImage(picture))));
    }
    return result;
  };
  const auto one_thread = texts(1);
  EXPECT_EQ(one_thread, texts(1));
  EXPECT_EQ(one_thread, texts(2));
  EXPECT_EQ(one_thread, texts(5));
}

TEST(RealPictures, SmallerInputFindsPeopleToo) {
  SKIP_WITHOUT_DATA(kSmallModel);
  PoseNetworkConfig config = ModelConfig();
  config.model = DataPath(kSmallModel);
  config.input_width_px = 320;
  config.input_height_px = 240;
  PoseNetwork network(config);
  EXPECT_EQ(DetectIn(network, "../models/test_p1.jpg").size(), 1U);
  EXPECT_EQ(DetectIn(network, "../models/test_p2.jpg").size(), 2U);
}

TEST(RealPictures, InputOfAnotherSizeThanTheGraphsIsRefused) {
  SKIP_WITHOUT_DATA(kModel);
  PoseNetworkConfig config = ModelConfig();
  config.input_width_px = 320;
  config.input_height_px = 240;
  try {
    PoseNetwork network(config);
    FAIL() << "a graph made for 432 x 368 took 320 x 240";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("input_width_px"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(config.model), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace posefusion
