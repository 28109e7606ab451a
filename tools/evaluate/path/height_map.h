// A model's lowest and highest points over a square grid of columns.
#pragma once

#include <limits>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "tools/evaluate/path/model_frame.h"

namespace farcell {

class HeightMap {
 public:
  static constexpr int kColumns = 512;    // along the longer side
  static constexpr int kGroundReach = 8;  // columns around a place in which its ground is sought
  // From every leaf of the pack, a page at a time. A triangle is sampled at its corners and, where it is larger than a
  // column, between them.
  static Result<HeightMap> create(const PackFile& pack);

  // A world point's place on the map, in columns.
  struct Place {
    double x = 0, y = 0;
  };
  Place placeOf(glm::dvec3 point) const;
  glm::dvec3 pointAt(const Place& place, double height) const;  // height: along the up axis

  double columnSize() const { return size_; }
  const ModelFrame& model() const { return model_; }
  // Infinite, of the sign that makes it no obstacle, where nothing is or beyond the map.
  double topAt(const Place& place) const { return valueAt(high_, place, -std::numeric_limits<double>::infinity()); }
  // The lowest point near the place; infinity where nothing is near.
  double groundAt(const Place& place) const { return valueAt(ground_, place, std::numeric_limits<double>::infinity()); }

 private:
  explicit HeightMap(const ModelFrame& model);
  void addTriangle(const glm::dvec3 (&corners)[3]);
  void add(glm::dvec3 point);
  void findGround();
  double valueAt(const std::vector<double>& values, const Place& place, double otherwise) const;

  ModelFrame model_;
  double size_ = 1;
  std::vector<double> low_, high_, ground_;
};

}  // namespace farcell
