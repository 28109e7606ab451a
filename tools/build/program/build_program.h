// farcell build, whoever shares its work.
#pragma once

#include "preprocess/build/crew.h"

namespace farcell {

// What main returns. crew: null for a process alone.
int buildProgram(int argc, char** argv, Crew* crew);

}  // namespace farcell
