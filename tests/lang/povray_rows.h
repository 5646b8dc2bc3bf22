// SPDX-License-Identifier: Apache-2.0
// Comparison with what POV-Ray wrote.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace vestige::lang::test {

/// Equal text, but for numbers that differ by the tolerance and take as many characters.
inline bool isNear(const std::string& a, const std::string& b, double tolerance) {
  if (a.size() != b.size()) return false;
  const char *p = a.c_str(), *q = b.c_str();
  while (*p && *q) {
    char *pEnd = nullptr, *qEnd = nullptr;
    const double x = std::strtod(p, &pEnd), y = std::strtod(q, &qEnd);
    if (*p != ' ' && *q != ' ' && pEnd != p && pEnd - p == qEnd - q) {
      if (!(std::abs(x - y) <= tolerance * std::max(1.0, std::abs(y)))) return false;
      p = pEnd, q = qEnd;
    } else if (*p++ != *q++) {
      return false;
    }
  }
  return true;
}

}  // namespace vestige::lang::test
