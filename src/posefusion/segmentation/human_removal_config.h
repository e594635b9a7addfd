#pragma once

#include "posefusion/segmentation/background_surfaces_config.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/mask_refinement.h"
#include "posefusion/segmentation/min_cut.h"
#include "posefusion/segmentation/person_region.h"
#include "posefusion/segmentation/seeds.h"

namespace posefusion {

/// How people are taken out of the picture (paper, section III-B).
struct HumanRemovalConfig {
  CellGridConfig cells;
  SeedConfig seeds;
  PersonRegionConfig region;
  BackgroundSurfacesConfig background_surfaces;
  MinCutConfig min_cut;
  MaskRefinementConfig mask;
};

template <class V>
void Describe(V& v, HumanRemovalConfig& c) {
  v.Group("cells", c.cells);
  v.Group("seeds", c.seeds);
  v.Group("region", c.region);
  v.Group("background_surfaces", c.background_surfaces);
  v.Group("min_cut", c.min_cut);
  v.Group("mask", c.mask);
}

}  // namespace posefusion
