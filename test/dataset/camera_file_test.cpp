#include "posefusion/dataset/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kPinhole = "width: 64\nheight: 48\nfx: 50.5\nfy: 51\ncx: 31.5\ncy: 23.5\n";
const std::string kScale = "depth_scale: 5000.0  # units per metre\n";

void ExpectRefused(const std::string& text, const std::string& message) {
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  WriteFileAtomically(path, text);
  EXPECT_THAT([&] { ReadCameraFile(path); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(path), HasSubstr(message))));
}

TEST(CameraFile, ReadsAllKeys) {
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  WriteFileAtomically(path, kPinhole + kScale + "distortion: [0.1, -0.2, 0.3, 0.4, 0.5]\n");
  const CameraFile file = ReadCameraFile(path);
  const CameraModel expected{64, 48, 50.5, 51, 31.5, 23.5, {0.1, -0.2, 0.3, 0.4, 0.5}};
  EXPECT_EQ(file.camera, expected);
  EXPECT_EQ(file.depth_scale, 5000);
}

TEST(CameraFile, DistortionIsOptionalAndMayBeShort) {
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  WriteFileAtomically(path, kPinhole + kScale);
  EXPECT_FALSE(ReadCameraFile(path).camera.HasDistortion());
  WriteFileAtomically(path, kPinhole + kScale + "distortion: [0.1, 0.2]\n");
  EXPECT_EQ(ReadCameraFile(path).camera.distortion[1], 0.2);
  EXPECT_EQ(ReadCameraFile(path).camera.distortion[2], 0);
}

TEST(CameraFile, NamesFileAndKeyOfWhatIsWrong) {
  ExpectRefused(kPinhole, "'depth_scale' is missing");
  ExpectRefused(kScale + "width: 64\n", "'height' is missing");
  ExpectRefused(kPinhole + kScale + "focal: 3\n", "unknown key 'focal'");
  ExpectRefused(kPinhole + "depth_scale: many\n", "'depth_scale': expected a number, got 'many'");
  ExpectRefused(kPinhole + "depth_scale: 0\n", "'depth_scale' is not positive");
  ExpectRefused(kPinhole + kScale + "distortion: 3\n", "'distortion'");
  ExpectRefused("width: 64\nheight: 0\nfx: 1\nfy: 1\ncx: 0\ncy: 0\n" + kScale, "64 x 0");
  ExpectRefused("- 1\n", "expected a map");
  ExpectRefused("a: [1\n", "line");
}

TEST(CameraFile, NamesAMissingFile) {
  EXPECT_THAT([] { ReadCameraFile("/nowhere/camera.yaml"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/nowhere/camera.yaml")));
}

}  // namespace
}  // namespace posefusion
