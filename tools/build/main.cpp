// farcell build: a pack from mesh files.
#include "tools/build/program/build_program.h"

int main(int argc, char** argv) { return farcell::buildProgram(argc, argv, nullptr); }
