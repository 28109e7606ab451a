// farcell build --mpi: what farcell-build becomes in an mpirun.
#include <mpi.h>

#include "tools/build/mpi/mpi_crew.h"
#include "tools/build/program/build_program.h"

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int code = 0;
  {
    farcell::MpiCrew crew;
    code = farcell::buildProgram(argc, argv, &crew);
  }
  MPI_Finalize();
  return code;
}
