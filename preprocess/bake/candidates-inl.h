// Samples of triangles that are not a surface everywhere or for everyone: looked at before they get a depth.
#if defined(FARCELL_BAKE_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_CANDIDATES_INL_H
#undef FARCELL_BAKE_CANDIDATES_INL_H
#else
#define FARCELL_BAKE_CANDIDATES_INL_H
#endif

#include <algorithm>

#include "preprocess/bake/alpha_threshold.h"
#include "preprocess/bake/rasterise.h"
#include "preprocess/bake/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// Of a vector of candidates, what decides.
struct Evidence {
  HWY_ALIGN float area[kLanes];    // twice, signed: counter-clockwise triangles show their front to the view
  HWY_ALIGN float planeW[kLanes];  // alphaThreshold
};

class CandidateTest {
 public:
  CandidateTest(const CellSoup& chunk, const Projection& projection, SampleImage& image, RasterScratch& scratch,
                TextureSampler& textures)
      : chunk_(chunk), projection_(projection), image_(image), scratch_(scratch), textures_(textures) {}

  // depth: ordered. What cannot win on either side is left out at once.
  void add(uint32_t payload, size_t element, uint32_t depth) {
    if (image_.front[element] >> 32 > depth && image_.back[element] >> 32 < depth) return;
    CandidateList& list = scratch_.candidates;
    list.payloads[list.count] = payload;
    list.elements[list.count] = static_cast<uint32_t>(element);
    list.depths[list.count] = depth;
    if (++list.count == CandidateList::kCapacity) flush();
  }

  void flush() {
    CandidateList& list = scratch_.candidates;
    for (size_t at = 0; at < list.count; at += hn::Lanes(DF())) test(at, std::min(list.count - at, hn::Lanes(DF())));
    list.count = 0;
  }

 private:
  static uint32_t triangleOf(uint32_t payload) { return (payload & ~kUnsettled) >> 1; }

  void test(size_t at, size_t count) {
    const DF df;
    const CandidateList& list = scratch_.candidates;
    HWY_ALIGN uint32_t triangles[kLanes];
    HWY_ALIGN float position[2][kLanes], middle[2][kLanes];
    SamplePlace places[kLanes];
    const float half = 0.5f * static_cast<float>((1 << image_.edgeShift) - 1);
    for (size_t lane = 0; lane < hn::Lanes(df); ++lane) {
      const size_t i = at + std::min(lane, count - 1);
      triangles[lane] = triangleOf(list.payloads[i]);
      const SamplePlace place = places[lane] = samplePlace(list.elements[i], image_);
      const float x = static_cast<float>(place.column << image_.edgeShift) - image_.centreIndex;
      const float y = static_cast<float>(place.row << image_.edgeShift) - image_.centreIndex;
      position[0][lane] = x + static_cast<float>(place.x);
      position[1][lane] = y + static_cast<float>(place.y);
      middle[0][lane] = x + half;
      middle[1][lane] = y + half;
    }
    TriangleLanes lanes;
    loadTriangles(chunk_, triangles, lanes);
    VF p[3][3];
    for (size_t k = 0; k < 3; ++k)
      for (size_t axis = 0; axis < 3; ++axis) p[k][axis] = hn::Load(df, lanes.positions[k][axis]);
    const Evidence evidence = evidenceOf(p, hn::Load(df, middle[0]), hn::Load(df, middle[1]));
    const Footprints footprints =
        footprintsOf(lanes, weightsAt(p, projection_, hn::Load(df, position[0]), hn::Load(df, position[1])));
    for (size_t lane = 0; lane < count; ++lane) {
      const uint32_t kind = scratch_.kinds[triangles[lane]];
      if ((kind & kHasAlpha) != 0 && !isSurface(lanes.textures[lane], footprints, evidence, lane, places[lane]))
        continue;
      write(at + lane, (kind & kSingleSided) != 0 ? evidence.area[lane] : 0, (kind & kSingleSided) == 0);
    }
  }

  // In the middle of texels; the plane is that of the rasteriser up to rounding.
  HWY_INLINE Evidence evidenceOf(const VF (&p)[3][3], VF x, VF y) const {
    const DF df;
    const VF x0 = snapped(dot(p[0], projection_.right), projection_),
             y0 = snapped(dot(p[0], projection_.up), projection_);
    const VF x1 = hn::Sub(snapped(dot(p[1], projection_.right), projection_), x0);
    const VF y1 = hn::Sub(snapped(dot(p[1], projection_.up), projection_), y0);
    const VF x2 = hn::Sub(snapped(dot(p[2], projection_.right), projection_), x0);
    const VF y2 = hn::Sub(snapped(dot(p[2], projection_.up), projection_), y0);
    const VF qx = hn::Sub(x, x0), qy = hn::Sub(y, y0);
    const VF area = hn::Sub(hn::Mul(x1, y2), hn::Mul(x2, y1));
    const VF divisor = hn::IfThenElse(hn::Eq(area, hn::Zero(df)), hn::Set(df, 1.0f), area);
    const VF first = hn::Div(hn::Sub(hn::Mul(qx, y2), hn::Mul(x2, qy)), divisor);
    const VF second = hn::Div(hn::Sub(hn::Mul(x1, qy), hn::Mul(qx, y1)), divisor);
    const VF w0 = dot(p[0], projection_.toward);
    const VF along = hn::Add(hn::Mul(first, hn::Sub(dot(p[1], projection_.toward), w0)),
                             hn::Mul(second, hn::Sub(dot(p[2], projection_.toward), w0)));
    Evidence evidence;
    hn::Store(area, df, evidence.area);
    hn::Store(hn::Add(w0, along), df, evidence.planeW);
    return evidence;
  }

  bool isSurface(uint32_t texture, const Footprints& footprints, const Evidence& evidence, size_t lane,
                 const SamplePlace& place) const {
    const auto pair = [&](const float(&values)[2][kLanes]) { return glm::vec2(values[0][lane], values[1][lane]); };
    const float alpha =
        textures_.sample({texture, pair(footprints.at), pair(footprints.alongX), pair(footprints.alongY)}).w;
    const float w = evidence.planeW[lane];
    return alpha > (projection_.isAntipode ? alphaThreshold(mirrored(place, image_), -w, image_)
                                           : alphaThreshold(place, w, image_));
  }

  // facing: greater than 0 where the front is seen from the view, less where from the antipode.
  void write(size_t candidate, float facing, bool bothSides) {
    const CandidateList& list = scratch_.candidates;
    const size_t element = list.elements[candidate];
    const uint64_t key = uint64_t{list.depths[candidate]} << 32 | list.payloads[candidate];
    if (bothSides || facing > 0) image_.front[element] = std::max(image_.front[element], key ^ 0xffffffffu);
    if (bothSides || facing < 0) image_.back[element] = std::min(image_.back[element], key);
  }

  const CellSoup& chunk_;
  const Projection& projection_;
  SampleImage& image_;
  RasterScratch& scratch_;
  TextureSampler& textures_;
};

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
