#include "posefusion/dataset/trajectory_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/lie.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDigitTolerance = 2e-9;  ///< nine decimals are written

Trajectory RandomTrajectory(int num_poses) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    Vector6d twist;
    for (double& value : twist) value = coordinate(random);
    trajectory.push_back({1305031102175304001 + i * 33'333'333LL, ExpSE3(twist)});
  }
  return trajectory;
}

TEST(TrajectoryFile, RoundTripKeepsStampsAndPoses) {
  const TemporaryFolder folder;
  const Trajectory trajectory = RandomTrajectory(100);
  WriteTrajectory(trajectory, folder / "trajectory.txt");
  const Trajectory read = ReadTrajectory(folder / "trajectory.txt");
  ASSERT_EQ(read.size(), trajectory.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp_ns, trajectory[i].stamp_ns);
    const Vector6d difference = LogSE3(read[i].T_map_camera.inverse() * trajectory[i].T_map_camera);
    EXPECT_LT(difference.norm(), 5 * kDigitTolerance);
  }
}

TEST(TrajectoryFile, WritesTheFormatOfTheBenchmark) {
  const TemporaryFolder folder;
  StampedPose pose{1'500'000'000, Eigen::Isometry3d::Identity()};
  pose.T_map_camera.translation() << 1, -2, 0.25;
  WriteTrajectory({pose}, folder / "a.txt");
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"),
            "# timestamp tx ty tz qx qy qz qw\n1.500000 1.000000000 -2.000000000 0.250000000 "
            "0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(TrajectoryFile, ReadsWhatOtherProgramsWrite) {
  const TemporaryFolder folder;
  WriteFileAtomically(
      folder / "a.txt",
      "# comment\n\n2.5 1 2 3 0 0 0 2\n1e0\t0,0,0\t0 0 0 -1\r\n2.5 7 2 3 0 0 0 1\n");
  const Trajectory read = ReadTrajectory(folder / "a.txt");
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].stamp_ns, 1'000'000'000);
  EXPECT_TRUE(read[0].T_map_camera.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(read[1].T_map_camera.translation(), Eigen::Vector3d(1, 2, 3));
  const Trajectory last = LastOfEachStamp(read);
  ASSERT_EQ(last.size(), 2U);
  EXPECT_EQ(last[1].T_map_camera.translation(), Eigen::Vector3d(7, 2, 3));
}

TEST(TrajectoryFile, NamesFileAndLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  const auto expect_refused = [&](const std::string& text, const std::string& message) {
    WriteFileAtomically(path, text);
    EXPECT_THAT([&] { ReadTrajectory(path); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(path), HasSubstr(message))));
  };
  const std::string good = "1 0 0 0 0 0 0 1\n";
  expect_refused(good + "2 0 0 0 0 0 0\n", ":2: expected");
  expect_refused(good + "2 0 0 0 0 0 0 1 5\n", "9 columns");
  expect_refused(good + "2 0 0 nan 0 0 0 1\n", ":2: 'nan' is not a finite number");
  expect_refused(good + "2 0 0 1.5x 0 0 0 1\n", "'1.5x'");
  expect_refused(good + "2 0 0 0 0 0 0 0\n", ":2: quaternion is zero");
  expect_refused("x 0 0 0 0 0 0 1\n", ":1: 'x'");
  expect_refused("# nothing\n", "holds no poses");
  EXPECT_THAT([] { ReadTrajectory("/nowhere/a.txt"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/a.txt")));
  EXPECT_THAT([] { WriteTrajectory({}, "/nowhere/a.txt"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/a.txt")));
}

}  // namespace
}  // namespace posefusion
