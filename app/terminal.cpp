// SPDX-License-Identifier: Apache-2.0
#include "app/terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace vestige::app {
namespace {

void tell(const char* colour, const char* word, const std::string& sentence) {
  const bool coloured = wantsColour(STDERR_FILENO);
  std::cerr << "vestige: " << (coloured ? colour : "") << word << (coloured ? "\x1b[0m " : " ")
            << sentence << std::endl;
}

}  // namespace

bool isTerminal(int descriptor) { return isatty(descriptor) == 1; }

bool wantsColour(int descriptor) {
  const char* refused = std::getenv("NO_COLOR");
  return isTerminal(descriptor) && !(refused && *refused);
}

int terminalWidth(int descriptor) {
  winsize size{};
  int width = 80;
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    width = size.ws_col;
  else if (const char* columns = std::getenv("COLUMNS"); columns && std::atoi(columns) > 0)
    width = std::atoi(columns);
  return std::max(width, 40);
}

void complain(const std::string& sentence) { tell("\x1b[1;31m", "error:", sentence); }
void warn(const std::string& sentence) { tell("\x1b[1;35m", "warning:", sentence); }
void say(const std::string& sentence) { std::cerr << sentence << std::endl; }

std::string durationText(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(seconds, 0.0));
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string count(long long n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace vestige::app
