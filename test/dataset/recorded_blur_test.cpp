// The blur filter on recorded frames.

#include <gtest/gtest.h>

#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/image/blur_filter.h"
#include "test/image/synthetic_images.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

constexpr double kMaxDroppedShare = 0.02;  ///< some frames of the sequence are blurred indeed
constexpr double kMinFoundShare = 0.9;
constexpr int kBlurEvery = 8;  ///< frames; a blurred one now and then

TEST(RecordedBlur, FewFramesOfASteadyCameraAreDropped) {
  for (const char* name : {"fr1_xyz", "fr1_xyz_people", "ist_corridor"}) {
    SKIP_WITHOUT_DATA(name);
    TumFolderSource source(DataPath(name));
    BlurFilter filter{BlurFilterConfig()};
    while (const auto frame = source.Next()) filter.Judge(frame->rgb, frame->stamp_ns);
    EXPECT_LE(filter.counts().dropped, kMaxDroppedShare * filter.counts().seen) << name;
  }
}

TEST(RecordedBlur, AddedMotionBlurIsFound) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  for (const double noise : {0.0, 2.0}) {
    TumFolderSource source(DataPath("fr1_xyz"));
    BlurFilter filter{BlurFilterConfig()};
    int num_blurred = 0;
    int num_found = 0;
    for (int i = 0; const auto frame = source.Next(); ++i) {
      if (i % kBlurEvery != kBlurEvery - 1) {
        filter.Judge(frame->rgb, frame->stamp_ns);
        continue;
      }
      const int length_px = 8 + 4 * (num_blurred % 5);
      const cv::Mat blurred = MotionBlurred(frame->rgb, length_px, 0.4 * num_blurred);
      num_found += filter.Judge(WithNoise(blurred, noise, i), frame->stamp_ns).keep ? 0 : 1;
      ++num_blurred;
    }
    EXPECT_GE(num_found, kMinFoundShare * num_blurred) << "noise " << noise;
  }
}

}  // namespace
}  // namespace posefusion
