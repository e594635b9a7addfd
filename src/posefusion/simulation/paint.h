#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace posefusion::paint {

/// Procedural pictures for surfaces: CV_8UC3 R G B, square, seamless where a surface repeats them.

using Color = cv::Vec3b;  ///< R G B as stored in a Texture

cv::Mat Plain(Color color);
/// Painted wallpaper with a faint grain; `contrast` in grey levels.
cv::Mat Plaster(Color color, double contrast, std::uint32_t seed);
/// 16 boards side by side with joints and grain.
cv::Mat FloorBoards(Color color, std::uint32_t seed);
/// Grain along u.
cv::Mat Wood(Color color, std::uint32_t seed);
cv::Mat Carpet(Color color, Color pattern, std::uint32_t seed);
cv::Mat CeilingTiles(std::uint32_t seed);

/// 8 x 2 spines with lettering, each a cell of the picture.
cv::Mat BookSpines(std::uint32_t seed);
cv::Mat Poster(std::uint32_t seed);
cv::Mat Whiteboard(std::uint32_t seed);
cv::Mat Corkboard(std::uint32_t seed);
cv::Mat Keyboard(std::uint32_t seed);
cv::Mat Screen(std::uint32_t seed);
cv::Mat Cardboard(std::uint32_t seed);
cv::Mat PrintedPaper(std::uint32_t seed);
cv::Mat OutsideWindow(std::uint32_t seed);
cv::Mat Radiator();
cv::Mat Leaves(std::uint32_t seed);

enum class Cloth { kPlain, kStripes, kChecks, kPrint, kDenim };
cv::Mat Fabric(Cloth cloth, Color color, Color second, std::uint32_t seed);
/// Wrapped once around the head: the face in the middle, hair elsewhere.
cv::Mat Head(Color skin, Color hair, std::uint32_t seed);

/// Seamless noise of mean 0 and about +-1 in CV_32FC1, `cells` lattice cells wide and high in its
/// coarsest octave.
cv::Mat Noise(int size, int cells_x, int cells_y, int octaves, std::uint32_t seed);

/// `color` times (1 + noise * amplitude).
cv::Mat Shade(Color color, const cv::Mat& noise, double amplitude);

}  // namespace posefusion::paint
