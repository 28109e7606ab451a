// "At equal time" and "at equal error": what each other kind of drawing comes to where one renderer, the subject, is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/evaluate/report/entry.h"
#include "tools/evaluate/report/pareto.h"

namespace farcell {

// The error to expect of a kind in `ms`, from its measured points: between two neighbours on their Pareto front, on the
// line through the logarithms of both; beyond the slowest, its error. Nothing below the fastest. REQUIRES: points.
std::optional<double> errorAtTime(std::span<const ErrorAndTime> points, double ms);
// The time to expect for `error`, alike: beyond the largest error of the front, its time. Nothing below the least
// error.
std::optional<double> timeAtError(std::span<const ErrorAndTime> points, double error);

// One kind from one camera.
struct EqualEntry {
  std::string kind;
  double ms = 0, error = 0;  // of the subject: median frame, paperError
  std::optional<double>
      errorThere;                 // of the kind in the subject's time; nothing: it takes longer whatever its settings
  std::optional<double> msThere;  // of the kind with the subject's error; nothing: it has more whatever its settings
};

struct EqualCamera {
  std::string camera;
  std::string stem;
  std::vector<EqualEntry> kinds;  // in order of first occurrence
};

// One kind over all cameras that see something.
struct EqualSummary {
  std::string kind;
  size_t cameras = 0;
  size_t subjectBetter = 0;  // cameras from which the subject has less error in its time than the kind has in it
  size_t neverAsFast = 0;    // of these, such from which errorThere is nothing
  size_t neverAsGood = 0;    // cameras from which msThere is nothing
  std::optional<double> errorRatio;  // geometric mean of the subject's error / errorThere, where there is one
  std::optional<double> worstErrorRatio;
  std::optional<double> speed;  // geometric mean of msThere / the subject's time, where there is one
  std::optional<double> leastSpeed;
};

struct EqualTable {
  std::string subject;  // name of the renderer; empty: none, and nothing else is here
  std::vector<EqualCamera> cameras;
  std::vector<EqualSummary> kinds;
};

// The subject is the first renderer of the kind auto, else the first of the class mixed. Cameras that see nothing are
// left out.
EqualTable equalTable(std::span<const Entry> entries);

}  // namespace farcell
