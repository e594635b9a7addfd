#pragma once

#include <string>

namespace posefusion {

/// Writes a file so that readers see either the old or the complete new contents: everything goes
/// to `<path>.tmp` beside it, which is then renamed.
/// @throws std::runtime_error naming `path` and the system's reason; nothing is left behind.
void WriteFileAtomically(const std::string& path, const std::string& contents);

/// The bytes of a file. @throws std::runtime_error naming `path` and the system's reason.
std::string ReadWholeFile(const std::string& path);

}  // namespace posefusion
