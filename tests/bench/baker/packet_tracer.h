// The alternative baker: Embree packets of 16 coherent rays, samples shaded and averaged like the baker's.
#pragma once

#include <embree3/rtcore.h>

#include "preprocess/bake/view_baker.h"

namespace farcell::bench {

class PacketTracer {
 public:
  PacketTracer(const CellSoup& soup, bool robust);
  ~PacketTracer();
  PacketTracer(const PacketTracer&) = delete;
  PacketTracer& operator=(const PacketTracer&) = delete;

  // Traces the texels of `area` only (its rectangle), which spares the tracer the empty part of the image.
  BakedView bake(const ViewFrame& frame, const BakeSettings& settings, const BakedView& area) const;

 private:
  const CellSoup& soup_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace farcell::bench
