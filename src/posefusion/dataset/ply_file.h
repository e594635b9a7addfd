#pragma once

#include <string>

#include "posefusion/surfel/surfel_cloud.h"

namespace posefusion {

/// Surfel maps as binary little-endian PLY with one vertex per surfel:
///
///   float x y z (map frame, metres), float nx ny nz, uchar red green blue, float radius (metres),
///   float confidence, double first_seen last_seen (seconds after the comment `stamp_origin_ns N`)
///
/// MeshLab and CloudCompare show the colours and offer the rest as scalar fields; those hold
/// floats, which is why the stamps count from the earliest one. To the nanosecond they are exact
/// over a hundred days.

/// Replaces the file at once. @throws std::runtime_error naming a file that cannot be written.
void WritePly(const SurfelCloud& cloud, const std::string& path);

/// Reads a file that WritePly or a program that kept its vertex properties has written, in any
/// order of properties and of any scalar type; other properties are skipped. x y z must be there,
/// the rest defaults to zero. Elements other than vertices may only follow them.
/// @throws std::runtime_error naming a file that cannot be read or is none of these.
SurfelCloud ReadPly(const std::string& path);

}  // namespace posefusion
