#pragma once

#include "posefusion/segmentation/background_surfaces_config.h"
#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/mask_refinement.h"
#include "posefusion/segmentation/min_cut.h"
#include "posefusion/segmentation/near_people.h"
#include "posefusion/segmentation/people_colours.h"
#include "posefusion/segmentation/person_region.h"
#include "posefusion/segmentation/person_tracks.h"
#include "posefusion/segmentation/remembered_people.h"
#include "posefusion/segmentation/seeds.h"

namespace posefusion {

enum class KeypointPolicy {
  kWait,       ///< it waits for them for a while, then goes on as with propagate
  kPropagate,  ///< the people of the frame before are carried over
  kPass,       ///< nobody is cut out
};

/// How people are taken out of the picture (paper, section III-B).
struct HumanRemovalConfig {
  bool enabled = true;  ///< false: nobody is removed
  /// What happens to a frame whose own keypoints are not there yet.
  KeypointPolicy policy = KeypointPolicy::kPropagate;
  double max_wait_s = 0.1;  ///< policy wait: so long at most
  double max_start_wait_s =
      1.0;                 ///< frames before the first keypoints wait for them; not with pass
  double history_s = 1.5;  ///< frames are kept for keypoints that come so late
  CellGridConfig cells;
  SeedConfig seeds;
  PersonRegionConfig region;
  BackgroundSurfacesConfig background_surfaces;
  MinCutConfig min_cut;
  MaskRefinementConfig mask;
  CarryConfig carry;
  PersonHoldConfig hold;
  RememberedPeopleConfig remembered_people;
  PeopleColoursConfig people_colours;
  NearPeopleConfig near_people;
};

template <class V>
void Describe(V& v, HumanRemovalConfig& c) {
  v.Field("enabled", c.enabled);
  v.Choice("policy", c.policy, {"wait", "propagate", "pass"});
  v.Field("max_wait_s", c.max_wait_s, 0.0, 60.0);
  v.Field("max_start_wait_s", c.max_start_wait_s, 0.0, 10.0);
  v.Field("history_s", c.history_s, 0.05, 60.0);
  v.Group("cells", c.cells);
  v.Group("seeds", c.seeds);
  v.Group("region", c.region);
  v.Group("background_surfaces", c.background_surfaces);
  v.Group("min_cut", c.min_cut);
  v.Group("mask", c.mask);
  v.Group("carry", c.carry);
  v.Group("hold", c.hold);
  v.Group("remembered_people", c.remembered_people);
  v.Group("people_colours", c.people_colours);
  v.Group("near_people", c.near_people);
}

}  // namespace posefusion
