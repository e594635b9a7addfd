#include "posefusion/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <stdexcept>

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

enum class Policy { kWait, kPass };

struct InnerConfig {
  double radius_m = 0.1;
  Policy policy = Policy::kWait;
};

template <class V>
void Describe(V& v, InnerConfig& c) {
  v.Field("radius_m", c.radius_m, 0.01, 1.0);
  v.Choice("policy", c.policy, {"wait", "pass"});
}

struct OuterConfig {
  bool enabled = true;
  int count = 3;
  std::string name = "map";
  InnerConfig inner;
};

template <class V>
void Describe(V& v, OuterConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("count", c.count, 1, 10);
  v.Field("name", c.name);
  v.Group("inner", c.inner);
}

OuterConfig Read(const std::string& yaml) {
  OuterConfig config;
  ApplyYaml(YAML::Load(yaml), "outer", config);
  return config;
}

void ExpectRefused(const std::string& yaml, const std::string& key, const std::string& reason) {
  EXPECT_THAT([&] { Read(yaml); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(key + ": "), HasSubstr(reason))))
      << yaml;
}

TEST(Config, MissingKeysKeepTheirDefaults) {
  for (const char* yaml : {"", "{}", "~", "inner: {}", "inner:"}) {
    const OuterConfig config = Read(yaml);
    EXPECT_TRUE(config.enabled);
    EXPECT_EQ(config.count, 3);
    EXPECT_EQ(config.inner.radius_m, 0.1);
  }
}

TEST(Config, ReadsEveryTypeOfValue) {
  const OuterConfig config =
      Read("{enabled: false, count: 10, name: odom/map, inner: {radius_m: 1, policy: pass}}");
  EXPECT_FALSE(config.enabled);
  EXPECT_EQ(config.count, 10);
  EXPECT_EQ(config.name, "odom/map");
  EXPECT_EQ(config.inner.radius_m, 1.0);
  EXPECT_EQ(config.inner.policy, Policy::kPass);
}

TEST(Config, UnknownKeysAreNamedInFull) {
  ExpectRefused("{cuont: 3}", "outer.cuont", "unknown key");
  ExpectRefused("{inner: {radius: 0.1}}", "outer.inner.radius", "unknown key");
}

TEST(Config, ValuesOutOfRangeAreNamedWithTheRange) {
  ExpectRefused("{count: 0}", "outer.count", "0 is outside [1, 10]");
  ExpectRefused("{inner: {radius_m: 2.5}}", "outer.inner.radius_m", "2.5 is outside [0.01, 1]");
  ExpectRefused("{inner: {radius_m: .nan}}", "outer.inner.radius_m", "nan is outside");
}

TEST(Config, ValuesOfAnotherTypeAreRefused) {
  ExpectRefused("{count: 2.5}", "outer.count", "expected a whole number, got '2.5'");
  ExpectRefused("{count: many}", "outer.count", "expected a whole number");
  ExpectRefused("{enabled: 7}", "outer.enabled", "expected true or false");
  ExpectRefused("{inner: {radius_m: [1]}}", "outer.inner.radius_m", "expected a number");
  ExpectRefused("{inner: 3}", "outer.inner", "expected a map");
  ExpectRefused("[1, 2]", "outer", "expected a map");
}

TEST(Config, ChoicesOutsideTheListAreRefusedWithTheList) {
  ExpectRefused("{inner: {policy: stop}}", "outer.inner.policy", "'stop' is none of wait pass");
}

TEST(Config, RoundTripsThroughYaml) {
  const OuterConfig config =
      Read("{enabled: false, count: 7, name: a b, inner: {radius_m: 0.123456789, policy: pass}}");
  const OuterConfig copy = Read(YAML::Dump(ToYaml(config)));
  EXPECT_EQ(copy.enabled, config.enabled);
  EXPECT_EQ(copy.count, config.count);
  EXPECT_EQ(copy.name, config.name);
  EXPECT_EQ(copy.inner.radius_m, config.inner.radius_m);
  EXPECT_EQ(copy.inner.policy, config.inner.policy);
}

TEST(Config, RangesAreCheckedWithoutAFile) {
  OuterConfig config;
  EXPECT_NO_THROW(CheckRanges("outer", config));
  config.inner.radius_m = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { CheckRanges("outer", config); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("outer.inner.radius_m")));
}

TEST(Config, UnreadableFilesAreNamed) {
  EXPECT_THAT([] { LoadYamlFile("/nowhere/a.yaml"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/nowhere/a.yaml: cannot be read")));
  const std::string path = testing::TempDir() + "config_test_broken.yaml";
  std::ofstream(path) << "a: [1\nb: 2\n";
  EXPECT_THAT([&] { LoadYamlFile(path); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(path), HasSubstr("line"))));
}

}  // namespace
}  // namespace posefusion
