// SPDX-License-Identifier: Apache-2.0
// Reads a text in a process of its own and measures its memory and time.
#pragma once
#include <string>

#include "lang/lang.h"

namespace vestige::lang::test {

struct Measured {
  double megabytes = 0;  ///< peak of resident memory, less that of an empty text
  double seconds = 0;    ///< of processor time
  int signal = 0;        ///< that ended the process; SIGXCPU after kMostSeconds
  std::string errors;    ///< "line:column: message", one a line; line 0: without a place
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // these take several times both
inline constexpr int kMostSeconds = 200;
inline constexpr double kMostMegabytes = 3 * 1024;
#else
inline constexpr int kMostSeconds = 30;
inline constexpr double kMostMegabytes = 1024;
#endif

Measured measured(const std::string& text, const Options& options = {});

}  // namespace vestige::lang::test
