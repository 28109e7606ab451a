#include "tools/evaluate/metrics/change.h"

#include <cmath>

#include "cache/base/check.h"

namespace farcell {

Change measureChange(const FramePair& before, const FramePair& now, std::vector<float>* map) {
  const size_t count = now.own.size();
  FARCELL_CHECK(count > 0 && now.reference.size() == count && before.own.size() == count &&
                before.reference.size() == count);
  if (map != nullptr) map->resize(count);
  Change sum;
  for (size_t i = 0; i < count; ++i) {
    const float own = now.own[i] - before.own[i], reference = now.reference[i] - before.reference[i];
    const float flicker = std::abs(own - reference);
    sum.own += std::abs(own);
    sum.reference += std::abs(reference);
    sum.flicker += flicker;
    if (map != nullptr) (*map)[i] = flicker;
  }
  const auto values = static_cast<double>(count);
  return {sum.own / values, sum.reference / values, sum.flicker / values};
}

}  // namespace farcell
