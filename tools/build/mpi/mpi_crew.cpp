#include "tools/build/mpi/mpi_crew.h"

#include <mpi.h>

#include <chrono>
#include <string>
#include <thread>

namespace farcell {
namespace {

// MPI's own waiting takes a whole core, which others on this machine may need for an hour of work.
void wait(MPI_Request& request) {
  int done = 0;
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace

MpiCrew::MpiCrew() {
  int size = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  size_ = static_cast<uint32_t>(size);
  rank_ = static_cast<uint32_t>(rank);
}

Result<> MpiCrew::together(Result<> own) {
  const auto none = static_cast<int>(size_);
  const int mine = own ? none : static_cast<int>(rank_);
  int first = none;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
  wait(request);
  if (first == none) return {};
  // Everybody hears why: the kind, then the message of the first that failed.
  int head[2] = {own ? 0 : static_cast<int>(own.error().kind), own ? 0 : static_cast<int>(own.error().message.size())};
  MPI_Bcast(head, 2, MPI_INT, first, MPI_COMM_WORLD);
  std::string message = first == mine ? own.error().message : std::string(static_cast<size_t>(head[1]), '\0');
  MPI_Bcast(message.data(), head[1], MPI_CHAR, first, MPI_COMM_WORLD);
  return tl::unexpected<Error>(Error{static_cast<ErrorKind>(head[0]), message});
}

}  // namespace farcell
