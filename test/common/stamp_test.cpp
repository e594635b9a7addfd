#include "posefusion/common/stamp.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

TEST(Stamp, ParsesDecimalSecondsExactly) {
  EXPECT_EQ(ParseStamp("1305031102.175304"), 1305031102175304000);
  EXPECT_EQ(ParseStamp("0.000000001"), 1);
  EXPECT_EQ(ParseStamp("12"), 12'000'000'000);
}

TEST(Stamp, RoundTripsThroughText) {
  for (const StampNs stamp : {0LL, 1LL, 1305031102175304000LL, 1305031102175304123LL}) {
    EXPECT_EQ(ParseStamp(FormatStamp(stamp)), stamp);
  }
  EXPECT_EQ(FormatStamp(1305031102175304000), "1305031102.175304");
}

TEST(Stamp, RefusesAnythingElse) {
  for (const char* text :
       {"", ".5", "1e9", "-1.0", "nan", "1.0000000001", "12345678901.0", "1.2.3"}) {
    EXPECT_FALSE(ParseStamp(text)) << text;
  }
}

}  // namespace
}  // namespace posefusion
