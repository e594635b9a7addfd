#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include <string>
#include <vector>

#include "posefusion/config/config_fields.h"

namespace posefusion {

/// What dynamic_reconfigure knows of keys: names, types, ranges and values. There a key is called
/// min_cut_sigma_m where yaml files say min_cut: {sigma_m: ...}.
std::string ReconfigureName(const std::string& key);

/// Names with types and ranges. `defaults` and nothing else gives the defaults.
dynamic_reconfigure::ConfigDescription ToDescription(const std::vector<ConfigField>& defaults);

/// Names with their values.
dynamic_reconfigure::Config ToConfigMessage(const std::vector<ConfigField>& fields);

/// The values of a request, one map within the other as in a yaml file.
/// @throws std::invalid_argument for names that are none of `fields` and other types than theirs.
YAML::Node ToNestedYaml(const dynamic_reconfigure::Config& request,
                        const std::vector<ConfigField>& fields);

}  // namespace posefusion
