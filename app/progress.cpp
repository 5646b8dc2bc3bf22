// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/terminal.h"

namespace vestige::app {
namespace {

constexpr double kPlainFirst = 2;     // seconds: a quick render prints no plain line at all
constexpr double kPlainInterval = 5;  // seconds between plain lines
constexpr double kShortest = 0.1;     // seconds between any two reports: quick passes are many
constexpr int kBarWidth = 28;         // columns, on terminals that have room

int percent(const Progress& p) { return int(100 * std::clamp(p.share, 0.0, 1.0)); }

void printJson(const Progress& p) {
  nlohmann::ordered_json line = {{"phase", p.phase},     {"share", p.share},
                                 {"elapsed", p.elapsed}, {"remaining", nullptr},
                                 {"samples", p.samples}, {"wanted", nullptr}};
  if (p.remaining >= 0) line["remaining"] = p.remaining;
  if (p.wanted > 0) line["wanted"] = p.wanted;
  if (p.quiet >= 0) line["quiet"] = p.quiet;
  std::cout << line.dump() << std::endl;
}

}  // namespace

ProgressStyle progressStyle(const std::string& word) {
  if (word == "bar") return ProgressStyle::bar;
  if (word == "plain") return ProgressStyle::plain;
  if (word == "json") return ProgressStyle::json;
  if (word == "none") return ProgressStyle::none;
  const char* kind = std::getenv("TERM");
  const bool canRedraw = isTerminal(STDERR_FILENO) && kind && std::strcmp(kind, "dumb") != 0;
  return canRedraw ? ProgressStyle::bar : ProgressStyle::plain;
}

std::string progressText(const Progress& p) {
  std::string text = std::strcmp(p.phase, "rendering") == 0 ? "" : fmt::format("{}, ", p.phase);
  if (p.wanted > 0)
    text += fmt::format("{} of {} samples", p.samples, p.wanted);
  else
    text += count(p.samples, "sample");
  if (p.quiet >= 0) text += fmt::format(", {:.0f} % quiet", std::floor(100 * p.quiet));
  if (p.remaining >= 0) text += fmt::format(", {} left", durationText(p.remaining));
  return text;
}

void ProgressReport::show(const Progress& progress) {
  if (progress.elapsed < next_) return;
  next_ = progress.elapsed + kShortest;
  if (style_ == ProgressStyle::bar) drawBar(progress);
  if (style_ == ProgressStyle::json) printJson(progress);
  if (style_ == ProgressStyle::plain && progress.elapsed >= kPlainFirst) {
    next_ = progress.elapsed + kPlainInterval;
    say(fmt::format("{} %, {}", percent(progress), progressText(progress)));
  }
}

void ProgressReport::drawBar(const Progress& progress) {
  const std::string text = progressText(progress);
  const int columns = terminalWidth(STDERR_FILENO) - 1;  // the last column would wrap
  const int width = std::min(kBarWidth, columns - int(text.size()) - 10);
  std::string line = fmt::format("{:3} % ", percent(progress));
  if (width >= 8) {
    const int done = int(width * std::clamp(progress.share, 0.0, 1.0));
    const bool colour = wantsColour(STDERR_FILENO);
    line += fmt::format("[{}{}{}{}] ", colour ? "\x1b[36m" : "", std::string(done, '='),
                        colour ? "\x1b[0m" : "", std::string(width - done, ' '));
    line += text;
  } else {
    line = (line + text).substr(0, columns);
  }
  std::cerr << '\r' << line << "\x1b[K" << std::flush;
  drawn_ = true;
}

void ProgressReport::clear() {
  if (drawn_) std::cerr << "\r\x1b[K" << std::flush;
  drawn_ = false;
}

}  // namespace vestige::app
