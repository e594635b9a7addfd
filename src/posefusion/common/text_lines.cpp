#include "posefusion/common/text_lines.h"

#include <algorithm>
#include <sstream>

#include "posefusion/common/atomic_file.h"

namespace posefusion {

std::vector<TextLine> ReadTextLines(const std::string& path) {
  std::istringstream file(ReadWholeFile(path));
  std::vector<TextLine> lines;
  std::string text;
  for (int number = 1; std::getline(file, text); ++number) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream words(text);
    TextLine line{number, {}};
    for (std::string word; words >> word;) line.columns.push_back(word);
    if (!line.columns.empty() && line.columns.front()[0] != '#') lines.push_back(line);
  }
  return lines;
}

std::string LineName(const std::string& path, const TextLine& line) {
  return path + ":" + std::to_string(line.number);
}

}  // namespace posefusion
