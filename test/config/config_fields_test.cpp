#include "posefusion/config/config_fields.h"

#include <gtest/gtest.h>

#include "posefusion/segmentation/human_removal_config.h"

namespace posefusion {
namespace {

const ConfigField& Find(const std::vector<ConfigField>& fields, const std::string& key) {
  for (const ConfigField& field : fields) {
    if (field.key == key) return field;
  }
  throw std::out_of_range(key);
}

TEST(ConfigFields, EveryKeyHasTypeValueAndRange) {
  HumanRemovalConfig config;
  config.min_cut.sigma_m = 0.5;
  const auto fields = ListFields(config);
  const ConfigField& sigma = Find(fields, "min_cut.sigma_m");
  EXPECT_EQ(sigma.type, ConfigField::Type::kDouble);
  EXPECT_EQ(sigma.value.as<double>(), 0.5);
  EXPECT_EQ(sigma.min, 0.01);
  EXPECT_EQ(sigma.max, 5.0);
  const ConfigField& policy = Find(fields, "policy");
  EXPECT_EQ(policy.type, ConfigField::Type::kChoice);
  EXPECT_EQ(policy.value.as<std::string>(), "propagate");
  EXPECT_EQ(policy.choices, (std::vector<std::string>{"wait", "propagate", "pass"}));
  EXPECT_EQ(Find(fields, "enabled").type, ConfigField::Type::kBool);
  EXPECT_EQ(Find(fields, "cells.size_px").type, ConfigField::Type::kInt);
}

}  // namespace
}  // namespace posefusion
