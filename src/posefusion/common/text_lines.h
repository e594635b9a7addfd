#pragma once

#include <string>
#include <vector>

namespace posefusion {

/// A line of a text file in columns.
struct TextLine {
  int number = 0;                    ///< in the file, from 1
  std::vector<std::string> columns;  ///< separated by blanks, tabs or commas; at least one
};

/// The lines of a TUM-style text file without comments ("# ...") and blank lines.
/// @throws std::runtime_error naming a file that cannot be read.
std::vector<TextLine> ReadTextLines(const std::string& path);

/// "path:12", the start of messages about a line.
std::string LineName(const std::string& path, const TextLine& line);

}  // namespace posefusion
