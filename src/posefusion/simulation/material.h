#pragma once

#include <cstdint>
#include <vector>

#include "posefusion/simulation/texture.h"

namespace posefusion {

/// What a surface is made of.
struct Material {
  Texture texture;
  float repeat_m;      ///< width of one repeat of the texture on surfaces that tile it
  float infrared;      ///< diffuse reflectance at the 830 nm of the depth projector, 0 to 1
  float emission = 0;  ///< radiance added: lamps and the sky behind a window
};

/// Numbers of the materials of rooms. Those of people follow from kFirstPersonMaterial on.
enum SurfaceMaterial : std::uint8_t {
  kBlankPaint,
  kWallpaper,
  kCeiling,
  kBoards,
  kLinoleum,
  kRug,
  kTableWood,
  kShelfWood,
  kDoorWood,
  kBooks,
  kPosterA,
  kPosterB,
  kPosterC,
  kPosterD,
  kWhiteboardSurface,
  kCork,
  kKeyboardSurface,
  kScreenA,
  kScreenB,
  kBlackPlastic,
  kGreyPlastic,
  kWhiteLacquer,
  kSteel,
  kSeatBlue,
  kSeatRed,
  kCurtain,
  kCardboardSurface,
  kPaper,
  kMug,
  kSky,
  kLampPanel,
  kRadiatorSurface,
  kLeaf,
  kClayPot,
  kBackpack,
  kFirstPersonMaterial
};

/// Materials of one person, in this order from PersonMaterial(person) on.
enum PersonSurface : std::uint8_t {
  kShirt,
  kTrousers,
  kSkin,
  kHeadSurface,
  kShoes,
  kNumPersonSurfaces
};

constexpr std::uint8_t PersonMaterial(int person, PersonSurface surface) {
  return static_cast<std::uint8_t>(kFirstPersonMaterial + person * kNumPersonSurfaces + surface);
}

/// All materials of a world, by number.
std::vector<Material> MakeMaterials(int humans, int seed);

}  // namespace posefusion
