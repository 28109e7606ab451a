// Ctrl-C as a flag that long work asks for. The first SIGINT or SIGTERM sets it; a second one kills.
#pragma once

#include "cache/base/result.h"

namespace farcell {

void installInterruptHandler();
bool interrupted();
// An Error of kind cancelled once interrupted, else success.
Result<> checkInterrupt();

}  // namespace farcell
