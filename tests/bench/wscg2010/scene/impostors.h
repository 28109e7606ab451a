// The paper's impostors: for each non-empty cell, the image with the smallest angle to the direction it is seen from.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "cache/schema/viewpoints.h"
#include "tests/bench/wscg2010/scene/image_baker.h"

namespace farcell::wscg {

struct ImpostorSettings {
  Content content = Content::sphere;
  int views = 320;
  ImageSettings image;
  bool operator==(const ImpostorSettings&) const = default;
};

// A flat rectangle through the cell's centre, as the world sees it: `origin` is the image's lower left corner (its
// cropped part), `alongX` and `alongY` its edges.
struct Billboard {
  glm::dvec3 origin{0}, alongX{0}, alongY{0};
  glm::dvec3 centre{0};  // of the cell
  const CellImage* image = nullptr;
  uint32_t cell = 0;  // index into CellIndex::occupied()
  int view = 0;
};

class ImpostorSet {
 public:
  // Bakes the images that are seen from `eyes` and no others. `index` must outlive the set. threads: 0: all.
  static Result<ImpostorSet> bake(const CellIndex& index, const ImpostorSettings& settings,
                                  std::span<const glm::dvec3> eyes, int threads = 0);

  // From one of the eyes: a billboard for each cell whose image is not empty, the farthest cell first.
  std::vector<Billboard> seenFrom(glm::dvec3 eye) const;
  const ImpostorSettings& settings() const { return settings_; }

 private:
  ImpostorSet(const CellIndex& index, const ImpostorSettings& settings, Viewpoints viewpoints);
  Billboard billboard(uint32_t cell, int view, const CellImage& image) const;

  const CellIndex* index_;
  ImpostorSettings settings_;
  Viewpoints viewpoints_;
  std::vector<std::map<int, CellImage>> images_;  // per cell, by view
};

}  // namespace farcell::wscg
