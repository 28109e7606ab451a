// What drawing costs on this machine, measured by drawing: a small model of its own, from a few distances, in every
// kind at one sample and at four.
#pragma once

#include "cache/base/result.h"
#include "runtime/cost/draw_costs.h"
#include "runtime/gl/context.h"

namespace farcell {

// Takes some tenths of a second. io: no directory for temporary files can be written.
Result<CostModel> measureCosts(GlContext& context);

// What is kept of this machine and renderer (cost_store.h), else measured and, where that can be, kept. `again`:
// whatever is kept.
Result<CostModel> machineCosts(GlContext& context, bool again);

}  // namespace farcell
