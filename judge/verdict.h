// SPDX-License-Identifier: Apache-2.0
// The result of judging a plugin.
#pragma once
#include <string>
#include <vector>

#include "judge/worst_event.h"

namespace vestige::judge {

/// The effort of the tests.
struct Effort {
  int samples = 1 << 15;     ///< of every statistical test, per set of parameters
  unsigned seed = 1;         ///< of all random numbers: the same seed finds the same
  double falseAlarm = 1e-5;  ///< probability that all chi-square tests together blame a good plugin
  int depth = 7;             ///< chi-square has up to 2^depth cells

  /// Number of events of the tests of single events, per set of parameters.
  int events() const { return samples < 64 ? 4 : samples / 16; }
};

/// The finding of one test, before a method is held responsible.
struct Finding {
  std::string test;
  std::string method = {};  ///< the one at fault, as far as this test alone can tell
  WorstEvent worst = {};
  int asked = 0,
      judged = 0;  ///< events where differences were tried, and where they were conclusive

  bool passed() const { return !(worst.error > 1); }
};

struct Verdict {
  std::string method;  ///< at fault: "pdf()"; where the test passed, the one it looks at
  std::string test;
  bool passed;
  std::string sentence;  ///< "pdf() is wrong: with { alpha 0.3 } ... sample() lands 1.98 times ..."
  std::string worst;     ///< the worst case as a line that reproduces it
  double excess;         ///< its error in units of the tolerance
  int events;            ///< how many were looked at
};

struct Timing {
  std::string method;
  double nanoseconds;  ///< a call
};

struct Judgement {
  std::vector<Verdict> verdicts;
  std::vector<Timing> timings;
  std::string unchecked = {};  ///< for the user: what was not tested; "": nothing

  bool passed() const;
  /// The first failure, or null.
  const Verdict* failure() const;
};

/// The verdict of a finding against its method, or against `culprit` if other findings point to it.
Verdict verdictOf(const Finding& finding, const std::string& culprit = "");

}  // namespace vestige::judge
