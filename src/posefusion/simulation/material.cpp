#include "posefusion/simulation/material.h"

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/paint.h"

namespace posefusion {
namespace {

using paint::Color;

void AddRoomShell(std::vector<Material>& m) {
  m.push_back({Texture(paint::Plain({216, 212, 200})), 1.0F, 0.75F});            // kBlankPaint
  m.push_back({Texture(paint::Plaster({226, 221, 208}, 5, 11)), 0.5F, 0.75F});   // kWallpaper
  m.push_back({Texture(paint::CeilingTiles(12)), 1.2F, 0.8F});                   // kCeiling
  m.push_back({Texture(paint::FloorBoards({176, 132, 88}, 13)), 2.0F, 0.5F});    // kBoards
  m.push_back({Texture(paint::Plaster({118, 128, 134}, 26, 14)), 0.9F, 0.45F});  // kLinoleum
  m.push_back({Texture(paint::Carpet({140, 44, 46}, {206, 182, 132}, 15)), 1.3F, 0.5F});  // kRug
  m.push_back({Texture(paint::Wood({188, 140, 90}, 16)), 0.9F, 0.55F});  // kTableWood
  m.push_back({Texture(paint::Wood({206, 178, 136}, 17)), 0.8F, 0.6F});  // kShelfWood
  m.push_back({Texture(paint::Wood({150, 106, 70}, 18)), 1.0F, 0.5F});   // kDoorWood
}

void AddPictures(std::vector<Material>& m) {
  m.push_back({Texture(paint::BookSpines(21)), 1.0F, 0.5F});
  for (std::uint32_t i = 0; i < 4; ++i) m.push_back({Texture(paint::Poster(30 + i)), 1.0F, 0.7F});
  m.push_back({Texture(paint::Whiteboard(22)), 1.0F, 0.7F});
  m.push_back({Texture(paint::Corkboard(23)), 1.0F, 0.6F});
  m.push_back({Texture(paint::Keyboard(24)), 1.0F, 0.2F});
  for (std::uint32_t i = 0; i < 2; ++i) {
    m.push_back({Texture(paint::Screen(40 + i)), 1.0F, 0.015F, 0.55F});
  }
}

void AddThings(std::vector<Material>& m) {
  using paint::Cloth;
  m.push_back({Texture(paint::Plaster({34, 34, 37}, 8, 51)), 0.3F, 0.03F});     // kBlackPlastic
  m.push_back({Texture(paint::Plaster({140, 142, 146}, 5, 52)), 0.3F, 0.4F});   // kGreyPlastic
  m.push_back({Texture(paint::Plaster({228, 228, 224}, 3, 53)), 0.5F, 0.75F});  // kWhiteLacquer
  m.push_back({Texture(paint::Plaster({150, 152, 156}, 10, 54)), 0.2F, 0.3F});  // kSteel
  m.push_back({Texture(paint::Fabric(Cloth::kPlain, {52, 74, 128}, {0, 0, 0}, 55)), 0.25F, 0.45F});
  m.push_back({Texture(paint::Fabric(Cloth::kPlain, {146, 52, 44}, {0, 0, 0}, 56)), 0.25F, 0.45F});
  m.push_back({Texture(paint::Fabric(Cloth::kStripes, {188, 176, 150}, {160, 140, 112}, 57)), 0.6F,
               0.6F});                                                       // kCurtain
  m.push_back({Texture(paint::Cardboard(58)), 0.4F, 0.6F});                  // kCardboard
  m.push_back({Texture(paint::PrintedPaper(59)), 0.3F, 0.75F});              // kPaper
  m.push_back({Texture(paint::Plaster({196, 70, 52}, 4, 60)), 0.2F, 0.5F});  // kMug
  m.push_back({Texture(paint::OutsideWindow(61)), 1.0F, 0.0F, 1.5F});        // kSky
  m.push_back({Texture(paint::Plain({255, 252, 244})), 1.0F, 0.6F, 1.6F});   // kLampPanel
  m.push_back({Texture(paint::Radiator()), 0.4F, 0.6F});
  m.push_back({Texture(paint::Leaves(62)), 0.4F, 0.6F});
  m.push_back({Texture(paint::Plaster({172, 96, 66}, 12, 63)), 0.3F, 0.5F});  // kClayPot
  m.push_back({Texture(paint::Fabric(Cloth::kStripes, {44, 92, 70}, {226, 170, 50}, 64)), 0.3F,
               0.4F});  // kBackpack
}

Color Choose(HashSequence& random, const std::vector<Color>& colors) {
  return colors[static_cast<std::size_t>(random.Below(static_cast<int>(colors.size())))];
}

void AddPerson(std::vector<Material>& m, int person, int seed) {
  const auto key =
      HashOf(static_cast<std::uint32_t>(seed), 900, static_cast<std::uint32_t>(person));
  HashSequence random(key);
  const Color shirt = Choose(random, {{186, 54, 50},
                                      {60, 96, 160},
                                      {228, 224, 214},
                                      {70, 120, 80},
                                      {214, 170, 60},
                                      {96, 70, 120},
                                      {120, 124, 130},
                                      {44, 46, 56}});
  const Color second = Choose(random, {{240, 236, 226}, {30, 36, 60}, {200, 60, 50}});
  const Color trousers =
      Choose(random, {{58, 74, 112}, {44, 44, 50}, {128, 112, 88}, {78, 80, 84}});
  const Color skin =
      Choose(random, {{226, 182, 154}, {198, 148, 116}, {140, 94, 66}, {236, 196, 172}});
  const Color hair = Choose(random, {{52, 36, 26}, {24, 22, 22}, {140, 104, 60}, {110, 108, 106}});
  const Color shoes = Choose(random, {{40, 36, 34}, {222, 222, 220}, {112, 74, 46}});
  const auto cloth = static_cast<paint::Cloth>(random.Below(4));
  const auto legs = random.Below(2) == 0 ? paint::Cloth::kDenim : paint::Cloth::kPlain;
  const float dark = 0.3F * static_cast<float>(trousers[0]) / 255.0F;
  m.push_back({Texture(paint::Fabric(cloth, shirt, second, key)), 1.0F, 0.5F});
  m.push_back({Texture(paint::Fabric(legs, trousers, {92, 108, 140}, key + 1)), 1.0F, 0.2F + dark});
  m.push_back({Texture(paint::Plaster(skin, 8, key + 2)), 0.3F, 0.55F});
  m.push_back({Texture(paint::Head(skin, hair, key + 3)), 1.0F, 0.35F});
  m.push_back({Texture(paint::Plaster(shoes, 14, key + 4)), 0.2F, 0.15F});
}

}  // namespace

std::vector<Material> MakeMaterials(int humans, int seed) {
  std::vector<Material> materials;
  AddRoomShell(materials);
  AddPictures(materials);
  AddThings(materials);
  for (int person = 0; person < humans; ++person) AddPerson(materials, person, seed);
  return materials;
}

}  // namespace posefusion
