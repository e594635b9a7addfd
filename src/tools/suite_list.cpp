#include "tools/suite_list.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include "posefusion/config/config.h"

namespace posefusion {
namespace {

/// An entry of the list.
struct Entry {
  std::string name;
  std::vector<std::string> sources;
  std::vector<std::string> presets = {kDefaultPreset};
  std::vector<int> seeds = {1};
  std::vector<std::string> options;
  std::string truth;
  std::string exclude;
  int frames = 0;
};

template <class T>
T As(const YAML::Node& node, const std::string& key, const char* what) {
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw std::invalid_argument(key + ": expected " + what);
  }
}

void ReadKey(const std::string& key, const YAML::Node& value, const std::string& full_key,
             Entry& entry) {
  using Texts = std::vector<std::string>;
  if (key == "name") {
    entry.name = As<std::string>(value, full_key, "a text");
  } else if (key == "sources") {
    entry.sources = As<Texts>(value, full_key, "a list of texts");
  } else if (key == "presets") {
    entry.presets = As<Texts>(value, full_key, "a list of texts");
  } else if (key == "seeds") {
    entry.seeds = As<std::vector<int>>(value, full_key, "a list of whole numbers");
  } else if (key == "options") {
    entry.options = As<Texts>(value, full_key, "a list of texts");
  } else if (key == "truth") {
    entry.truth = As<std::string>(value, full_key, "a text");
  } else if (key == "exclude") {
    entry.exclude = As<std::string>(value, full_key, "a text");
  } else if (key == "frames") {
    entry.frames = As<int>(value, full_key, "a whole number");
  } else {
    throw std::invalid_argument(full_key + ": unknown key");
  }
}

bool IsPlain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

/// A name that is good for a folder.
std::string FolderName(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !IsPlain(c); }, '_');
  return text;
}

bool UsesSeed(const Entry& entry) {
  std::string all = entry.truth + entry.exclude;
  for (const std::string& text : entry.sources) all += text;
  for (const std::string& text : entry.options) all += text;
  return all.find("{seed}") != std::string::npos;
}

void CheckEntry(const Entry& entry, const std::string& key,
                const std::vector<std::string>& presets) {
  const auto refuse = [&](const std::string& rest) { throw std::invalid_argument(key + rest); };
  if (entry.name.empty() || FolderName(entry.name) != entry.name || entry.name[0] == '.') {
    refuse(".name: '" + entry.name + "': letters, digits, '-', '_' and '.' make a name");
  }
  if (entry.sources.empty()) refuse(".sources: missing or empty");
  if (entry.presets.empty()) refuse(".presets: empty");
  if (entry.seeds.empty()) refuse(".seeds: empty");
  if (entry.frames < 0) refuse(".frames: is negative");
  for (const std::string& preset : entry.presets) {
    const bool known = std::find(presets.begin(), presets.end(), preset) != presets.end();
    if (preset != kDefaultPreset && !known) refuse(".presets: there is no preset '" + preset + "'");
  }
  if (entry.seeds.size() > 1 && !UsesSeed(entry)) {
    refuse(".seeds: nothing has a {seed} in it, every run would be the same");
  }
}

SuiteJob MakeJob(const Entry& entry, std::size_t source_index, const std::string& preset,
                 int seed) {
  const std::string seed_text = std::to_string(seed);
  SuiteJob job;
  job.name = entry.name;
  job.source_template = entry.sources[source_index];
  job.preset = preset;
  job.seed = seed;
  job.id = entry.name + "/";
  if (entry.sources.size() > 1) job.id += "source_" + std::to_string(source_index + 1) + "/";
  job.id += preset + "/seed_" + seed_text;
  job.source = Substituted(job.source_template, "seed", seed_text);
  const auto fill_in = [&](const std::string& text) {
    return Substituted(Substituted(text, "seed", seed_text), "source", job.source);
  };
  for (const std::string& option : entry.options) job.options.push_back(fill_in(option));
  job.truth = fill_in(entry.truth);
  job.exclude = fill_in(entry.exclude);
  job.frames = entry.frames;
  return job;
}

void AddJobs(const Entry& entry, std::vector<SuiteJob>& jobs) {
  for (std::size_t source = 0; source < entry.sources.size(); ++source) {
    for (const std::string& preset : entry.presets) {
      for (const int seed : entry.seeds) jobs.push_back(MakeJob(entry, source, preset, seed));
    }
  }
}

Entry ReadEntry(const YAML::Node& node, const std::string& key) {
  if (!node.IsMap()) throw std::invalid_argument(key + ": expected name, sources, ...");
  Entry entry;
  for (const auto& item : node) {
    const std::string name = As<std::string>(item.first, key, "keys of text");
    ReadKey(name, item.second, key + "." + name, entry);
  }
  return entry;
}

}  // namespace

std::string Substituted(std::string text, const std::string& name, const std::string& value) {
  const std::string pattern = "{" + name + "}";
  std::size_t place = text.find(pattern);
  while (place != std::string::npos) {
    text.replace(place, pattern.size(), value);
    place = text.find(pattern, place + value.size());
  }
  return text;
}

std::vector<SuiteJob> ReadSuite(const std::string& path, const std::vector<std::string>& presets) {
  const YAML::Node root = LoadYamlFile(path);
  if (!root.IsMap() || root.size() != 1 || !root["runs"] || !root["runs"].IsSequence()) {
    throw std::invalid_argument(path + ": expected one key 'runs' with a list");
  }
  std::vector<SuiteJob> jobs;
  for (std::size_t i = 0; i < root["runs"].size(); ++i) {
    const std::string key = path + ": runs[" + std::to_string(i) + "]";
    const Entry entry = ReadEntry(root["runs"][i], key);
    CheckEntry(entry, key, presets);
    AddJobs(entry, jobs);
  }
  std::set<std::string> ids;
  for (const SuiteJob& job : jobs) {
    if (!ids.insert(job.id).second) throw std::invalid_argument(path + ": " + job.id + " is twice");
  }
  if (jobs.empty()) throw std::invalid_argument(path + ": runs: empty");
  return jobs;
}

}  // namespace posefusion
