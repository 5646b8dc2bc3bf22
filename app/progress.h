// SPDX-License-Identifier: Apache-2.0
// How a render shows that it gets on.
#pragma once
#include <string>

#include "engine/render/session.h"

namespace vestige::app {

enum class ProgressStyle {
  bar,    ///< one line on stderr, redrawn in place
  plain,  ///< a line on stderr every few seconds
  json,   ///< an object a line on stdout
  none,
};
/// "auto" is a bar on a terminal, else plain lines. Any other word must be a style's name.
ProgressStyle progressStyle(const std::string& word);

/// Where Progress goes. [main thread]
class ProgressReport {
 public:
  explicit ProgressReport(ProgressStyle style) : style_(style) {}
  ~ProgressReport() { clear(); }
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  void show(const Progress& progress);
  /// Takes the bar away, so that other lines may follow.
  void clear();

 private:
  void drawBar(const Progress& progress);

  ProgressStyle style_;
  bool drawn_ = false;
  double next_ = 0;  ///< seconds of the render at which the next report is due
};

/// "29 of 64 samples, 12 s left"; "256 samples, 83 % quiet, 12 s left".
std::string progressText(const Progress& progress);

}  // namespace vestige::app
