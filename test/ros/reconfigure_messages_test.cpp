#include "posefusion_ros/reconfigure_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/config/config.h"
#include "posefusion_ros/nodelets/human_removal_config.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const HumanRemovalConfig kDefaults;

template <class Parameters>
auto Find(const Parameters& parameters, const std::string& name) {
  for (const auto& parameter : parameters) {
    if (parameter.name == name) return parameter;
  }
  throw std::out_of_range(name);
}

dynamic_reconfigure::Config Request(const std::string& name, double value) {
  dynamic_reconfigure::Config request;
  dynamic_reconfigure::DoubleParameter parameter;
  parameter.name = name;
  parameter.value = value;
  request.doubles.push_back(parameter);
  return request;
}

TEST(ReconfigureMessages, DescriptionHasTheDefaultsAndRangesOfTheStruct) {
  const auto description = ToDescription(ListFields(kDefaults));
  const auto& group = description.groups.at(0);
  EXPECT_EQ(Find(group.parameters, "min_cut_sigma_m").type, "double");
  EXPECT_EQ(Find(group.parameters, "enabled").type, "bool");
  EXPECT_THAT(Find(group.parameters, "policy").edit_method, HasSubstr("'value': 'propagate'"));
  EXPECT_EQ(Find(description.dflt.doubles, "min_cut_sigma_m").value, kDefaults.min_cut.sigma_m);
  EXPECT_EQ(Find(description.min.doubles, "min_cut_sigma_m").value, 0.01);
  EXPECT_EQ(Find(description.max.doubles, "min_cut_sigma_m").value, 5.0);
  EXPECT_EQ(Find(description.dflt.strs, "policy").value, "propagate");
}

TEST(ReconfigureMessages, ARequestBecomesTheStruct) {
  HumanRemovalConfig config;
  const auto fields = ListFields(config);
  dynamic_reconfigure::Config request = Request("min_cut_sigma_m", 0.123456789012345);
  dynamic_reconfigure::StrParameter policy;
  policy.name = "policy";
  policy.value = "wait";
  request.strs.push_back(policy);
  ApplyYaml(ToNestedYaml(request, fields), "human_removal", config);
  EXPECT_EQ(config.min_cut.sigma_m, 0.123456789012345);
  EXPECT_EQ(config.policy, KeypointPolicy::kWait);
  EXPECT_EQ(config.min_cut.radius_m, kDefaults.min_cut.radius_m);
}

TEST(ReconfigureMessages, ValuesOutOfRangeAreRefusedByTheStruct) {
  HumanRemovalConfig config;
  const YAML::Node node = ToNestedYaml(Request("min_cut_sigma_m", 99), ListFields(config));
  EXPECT_THAT([&] { ApplyYaml(node, "human_removal", config); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("human_removal.min_cut.sigma_m")));
}

TEST(ReconfigureMessages, UnknownNamesAndOtherTypesAreRefused) {
  const auto fields = ListFields(kDefaults);
  EXPECT_THAT([&] { ToNestedYaml(Request("no_such_key", 1), fields); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no_such_key")));
  EXPECT_THAT([&] { ToNestedYaml(Request("policy", 1), fields); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("policy: is of type str")));
}

}  // namespace
}  // namespace posefusion
