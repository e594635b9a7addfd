#include "posefusion/image/blur_filter.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/stage_clock.h"
#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

constexpr double kSensorNoise = 2;  ///< grey levels, of a structured-light camera indoors
constexpr double kAngles[] = {0, 0.4, 0.8, 1.2, 1.6, 2.4};

/// A filter and the numbering of frames that gives each its own noise.
class Sequence {
 public:
  explicit Sequence(const BlurFilterConfig& config = {}) : filter_(config) {}

  BlurDecision Show(const cv::Mat& image) {
    return filter_.Judge(WithNoise(image, kSensorNoise, ++num_shown_));
  }

  /// Number of frames kept of `count` showings.
  int NumKept(const cv::Mat& image, int count) {
    int num_kept = 0;
    for (int i = 0; i < count; ++i) num_kept += Show(image).keep ? 1 : 0;
    return num_kept;
  }

  const BlurCounts& counts() const { return filter_.counts(); }

 private:
  BlurFilter filter_;
  int num_shown_ = 0;
};

TEST(BlurFilter, FindsMotionBlurInEveryDirection) {
  for (const int length_px : {8, 12, 20, 40}) {
    for (const double angle_rad : kAngles) {
      Sequence sequence;
      EXPECT_EQ(sequence.NumKept(RoomImage(1), 10), 10);
      const BlurDecision decision =
          sequence.Show(MotionBlurred(RoomImage(1), length_px, angle_rad));
      EXPECT_FALSE(decision.keep) << length_px << " px at " << angle_rad;
      EXPECT_EQ(decision.reason, BlurReason::kBlurred);
      EXPECT_LT(decision.score, decision.threshold);
      EXPECT_TRUE(sequence.Show(RoomImage(1)).keep);
    }
  }
}

TEST(BlurFilter, KeepsWhatIsSlightlyOutOfFocus) {
  Sequence sequence;
  sequence.NumKept(RoomImage(1), 10);
  cv::Mat soft;
  cv::GaussianBlur(RoomImage(1), soft, {0, 0}, 0.4);
  EXPECT_TRUE(sequence.Show(soft).keep);
}

TEST(BlurFilter, DropsAtMostFiveInARow) {
  Sequence sequence;
  sequence.NumKept(RoomImage(1), 30);
  const cv::Mat blurred = MotionBlurred(RoomImage(1), 16, 0.5);
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(sequence.NumKept(blurred, 5), 0);
    const BlurDecision decision = sequence.Show(blurred);
    EXPECT_TRUE(decision.keep);
    EXPECT_EQ(decision.reason, BlurReason::kDropLimit);
  }
  EXPECT_EQ(sequence.counts().seen, 48);
  EXPECT_EQ(sequence.counts().dropped, 15);
}

TEST(BlurFilter, WallsAreNotBlurred) {
  for (const cv::Mat& wall : {WallImage(), GradientImage()}) {
    Sequence sequence;
    sequence.NumKept(RoomImage(1), 30);
    EXPECT_EQ(sequence.NumKept(wall, 20), 20);
    EXPECT_EQ(sequence.Show(wall).reason, BlurReason::kNoTexture);
    // The room is judged as before the wall.
    EXPECT_TRUE(sequence.Show(RoomImage(1)).keep);
    EXPECT_FALSE(sequence.Show(MotionBlurred(RoomImage(1), 12, 0.5)).keep);
  }
}

TEST(BlurFilter, StartsAtAWallOrBlurredWithoutHarm) {
  for (const cv::Mat& start : {WallImage(), MotionBlurred(RoomImage(1), 20, 0.5)}) {
    Sequence sequence;
    EXPECT_EQ(sequence.NumKept(start, 3), 3);
    EXPECT_EQ(sequence.NumKept(RoomImage(1), 20), 20);
    EXPECT_FALSE(sequence.Show(MotionBlurred(RoomImage(1), 12, 0.5)).keep);
  }
}

TEST(BlurFilter, LessLightIsNotBlur) {
  Sequence sequence;
  sequence.NumKept(RoomImage(1, 100), 60);
  EXPECT_EQ(sequence.NumKept(RoomImage(1, 40), 60), 60);
  EXPECT_FALSE(sequence.Show(MotionBlurred(RoomImage(1, 40), 20, 0.5)).keep);
  EXPECT_EQ(sequence.NumKept(RoomImage(1, 100), 60), 60);
  EXPECT_FALSE(sequence.Show(MotionBlurred(RoomImage(1, 100), 12, 0.5)).keep);
}

TEST(BlurFilter, RoomOfWeakerTextureIsAcceptedAfterThreeSeconds) {
  for (const int seed : {2, 3, 4, 5}) {
    Sequence sequence;
    sequence.NumKept(RoomImage(1, 100), 60);
    EXPECT_GE(sequence.NumKept(RoomImage(seed, 40), 100), 16);
    EXPECT_EQ(sequence.NumKept(RoomImage(seed, 40), 60), 60) << seed;
  }
}

TEST(BlurFilter, LongBlurredStretchIsForgottenWhenItEnds) {
  Sequence sequence;
  sequence.NumKept(RoomImage(1), 60);
  const cv::Mat blurred = MotionBlurred(RoomImage(1), 16, 0.5);
  EXPECT_EQ(sequence.NumKept(blurred, 60), 10) << "two seconds of a fall: the drop limit only";
  sequence.NumKept(blurred, 300);
  EXPECT_EQ(sequence.NumKept(RoomImage(1), 30), 30);
  EXPECT_FALSE(sequence.Show(blurred).keep);
}

TEST(BlurFilter, SoftImagesForGoodAreAccepted) {
  Sequence sequence;
  sequence.NumKept(RoomImage(1), 60);
  const cv::Mat soft = MotionBlurred(RoomImage(1), 16, 0.5);  // a lens out of focus, say
  sequence.NumKept(soft, 100);
  EXPECT_EQ(sequence.NumKept(soft, 60), 60);
}

TEST(BlurFilter, AbsoluteModeComparesThePaperScore) {
  BlurFilterConfig config;
  config.mode = BlurMode::kAbsolute;
  config.max_noise_grey_levels = 0;
  config.threshold = 0.5 * VarianceOfLaplacian(RoomImage(1));
  BlurFilter filter(config);
  const BlurDecision sharp = filter.Judge(RoomImage(1));
  EXPECT_TRUE(sharp.keep);
  EXPECT_EQ(sharp.score, VarianceOfLaplacian(RoomImage(1)));
  EXPECT_EQ(sharp.threshold, config.threshold);
  EXPECT_FALSE(filter.Judge(MotionBlurred(RoomImage(1), 16, 0.5)).keep);
  EXPECT_TRUE(filter.Judge(WallImage()).keep);
}

TEST(BlurFilter, DisabledKeepsEverythingAndCounts) {
  BlurFilterConfig config;
  config.enabled = false;
  Sequence sequence(config);
  EXPECT_EQ(sequence.NumKept(RoomImage(1), 3), 3);
  EXPECT_EQ(sequence.NumKept(MotionBlurred(RoomImage(1), 40, 0), 3), 3);
  EXPECT_EQ(sequence.counts().seen, 6);
  EXPECT_EQ(sequence.counts().dropped, 0);
}

TEST(BlurFilter, SameFramesGiveTheSameDecisions) {
  Sequence first;
  Sequence second;
  for (int i = 0; i < 40; ++i) {
    const cv::Mat image = MotionBlurred(RoomImage(i / 10), 1 + 5 * (i % 4), 0.1 * i);
    const BlurDecision a = first.Show(image);
    const BlurDecision b = second.Show(image);
    EXPECT_EQ(a.keep, b.keep);
    EXPECT_EQ(a.score, b.score);
    EXPECT_EQ(a.threshold, b.threshold);
  }
}

TEST(BlurFilter, CostsLittle) {
  BlurFilter filter{BlurFilterConfig()};
  const cv::Mat image = RoomImage(1);
  StageClock clock;
  for (int i = 0; i < 50; ++i) {
    const auto scope = clock.Measure("blur");
    filter.Judge(image);
  }
  std::vector<double> milliseconds;
  for (const StageTime& time : clock.times()) milliseconds.push_back(time.milliseconds);
  RecordProperty("median_ms", std::to_string(Quantile(milliseconds, 0.5)));
#ifdef NDEBUG
  EXPECT_LT(Quantile(milliseconds, 0.25), 2.0);  // a quartile: others may use the processor
#endif
}

TEST(BlurFilter, RefusesValuesOutOfRange) {
  BlurFilterConfig config;
  config.relative_threshold = 1.5;
  EXPECT_THROW(BlurFilter{config}, std::invalid_argument);
  EXPECT_THROW(BlurFilter{BlurFilterConfig()}.Judge(cv::Mat()), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
