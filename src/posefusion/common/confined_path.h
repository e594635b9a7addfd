#pragma once

#include <string>

namespace posefusion {

/// Where a file that somebody else names may be written: inside a folder and nowhere else.
///
/// The name is relative and may have folders, which must exist. Refused are absolute names, "..",
/// names of folders, links that lead out of the folder, links as the file itself, and, without
/// `overwrite`, names that exist. @throws std::invalid_argument saying what is wrong with `name`.
std::string ConfinedPath(const std::string& folder, const std::string& name, bool overwrite);

}  // namespace posefusion
