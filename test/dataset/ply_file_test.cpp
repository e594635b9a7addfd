#include "posefusion/dataset/ply_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

SurfelCloud RandomCloud(int num_surfels) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(-5, 5);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<StampNs> nanoseconds(0, 600'000'000'000);
  const auto next_byte = [&] { return static_cast<std::uint8_t>(byte(random)); };
  SurfelCloud cloud;
  for (int i = 0; i < num_surfels; ++i) {
    cloud.position_m.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    cloud.normal.push_back(cloud.position_m.back().normalized());
    cloud.rgb.push_back({next_byte(), next_byte(), next_byte()});
    cloud.radius_m.push_back(std::abs(coordinate(random)));
    cloud.confidence.push_back(std::abs(coordinate(random)));
    cloud.first_seen_ns.push_back(1305031102175304000 + nanoseconds(random));
    cloud.last_seen_ns.push_back(cloud.first_seen_ns.back() + nanoseconds(random));
  }
  return cloud;
}

void ExpectEqual(const SurfelCloud& a, const SurfelCloud& b) {
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.radius_m, b.radius_m);
  EXPECT_EQ(a.confidence, b.confidence);
  EXPECT_EQ(a.first_seen_ns, b.first_seen_ns);
  EXPECT_EQ(a.last_seen_ns, b.last_seen_ns);
}

TEST(PlyFile, RoundTripIsExact) {
  const TemporaryFolder folder;
  const SurfelCloud cloud = RandomCloud(1000);
  WritePly(cloud, folder / "map.ply");
  ExpectEqual(ReadPly(folder / "map.ply"), cloud);
}

TEST(PlyFile, EmptyMapIsAFileToo) {
  const TemporaryFolder folder;
  WritePly(SurfelCloud(), folder / "map.ply");
  EXPECT_EQ(ReadPly(folder / "map.ply").size(), 0U);
}

TEST(PlyFile, HeaderHasTheNamesThatViewersKnow) {
  const TemporaryFolder folder;
  WritePly(RandomCloud(1), folder / "map.ply");
  const std::string bytes = ReadWholeFile(folder / "map.ply");
  for (const char* line : {"property float nx", "property uchar red", "property float radius"}) {
    EXPECT_THAT(bytes, HasSubstr(line));
  }
}

TEST(PlyFile, ReadsOtherTypesOrdersAndElements) {
  const TemporaryFolder folder;
  std::string bytes =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty uchar quality\r\n"
      "property double z\r\nproperty short y\r\nproperty int8 x\r\nelement face 0\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n";
  const double z = 2.5;
  bytes += '\x07' + std::string(reinterpret_cast<const char*>(&z), sizeof z);
  bytes += std::string("\xff\xff\x03", 3);
  WriteFileAtomically(folder / "map.ply", bytes);
  const SurfelCloud cloud = ReadPly(folder / "map.ply");
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_EQ(cloud.position_m[0], Eigen::Vector3f(3, -1, 2.5));
  EXPECT_EQ(cloud.radius_m[0], 0);
}

TEST(PlyFile, NamesTheFileAndWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = folder / "map.ply";
  const auto expect_refused = [&](const std::string& bytes, const std::string& message) {
    WriteFileAtomically(path, bytes);
    EXPECT_THAT([&] { ReadPly(path); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(path), HasSubstr(message))));
  };
  WritePly(RandomCloud(10), path);
  const std::string good = ReadWholeFile(path);
  expect_refused(good.substr(0, good.size() - 1), "truncated");
  expect_refused(good.substr(0, 100), "header has no end");
  expect_refused("solid", "is no PLY");
  expect_refused("ply\nformat ascii 1.0\n", "ascii");
  expect_refused("ply\nelement vertex 1\nproperty float x\nend_header\n1234", "lack x, y or z");
  expect_refused("ply\nelement vertex -\nend_header\n", "vertex count '-'");
  EXPECT_THAT([] { WritePly(SurfelCloud(), "/nowhere/map.ply"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/map.ply")));
}

}  // namespace
}  // namespace posefusion
