// SPDX-License-Identifier: Apache-2.0
// Functions of objects, with POV-Ray's results; the program that reads the text measures.
#include <algorithm>

#include "lang/builtins.h"
#include "lang/measure.h"

namespace vestige::lang {
namespace {

/// Each question counts as so many steps: the answer takes a program much longer than a sum.
constexpr std::int64_t kQuestionSteps = 100;
/// POV-Ray's corners of what has no bounds.
constexpr double kFarAway = 1e10;

Measure& measureOf(const Call& c) {
  c.context.step(c.span, kQuestionSteps);
  return *c.context.options.measure;
}
const BlockPtr& object(const Call& c) { return std::get<BlockPtr>(c.args[0]); }
Measure::Point point(const Call& c, std::size_t i) {
  const Numbers v = c.vector(i);
  return {v.at(0), v.at(1), v.at(2)};
}
Numbers vectorOf(const Measure::Point& p) { return Numbers(p[0], p[1], p[2]); }

Datum refused(const Call& c, const std::string& why) {
  return c.complain(0, describe(c.args[0]) + " cannot be measured: " + why);
}

Datum extent(const Call& c, Measure::Point Measure::Extent::*corner) {
  Measure::Extent found;
  std::string why;
  if (!measureOf(c).extent(object(c), found, why)) return refused(c, why);
  Measure::Point p = found.*corner;
  for (double& x : p) x = std::clamp(x, -kFarAway, kFarAway);
  return vectorOf(p);
}

Datum inside(const Call& c) {
  bool isInside = false;
  std::string why;
  if (!measureOf(c).inside(object(c), point(c, 1), isInside, why)) return refused(c, why);
  return Numbers(isInside ? 1 : 0);
}

/// Where nothing is hit, and for a direction of no length, point and normal are <0, 0, 0>.
Datum trace(const Call& c) {
  Measure::Hit hit;
  const Measure::Point direction = point(c, 2);
  std::string why;
  if (direction != Measure::Point{} &&
      !measureOf(c).trace(object(c), point(c, 1), direction, hit, why))
    return refused(c, why);
  if (!hit.isHit) hit = {};
  c.context.tracedNormal = vectorOf(hit.normal);
  return vectorOf(hit.point);
}

}  // namespace

std::vector<Builtin> objectBuiltins() {
  return {
      {"inside", "ov", inside, false},
      {"max_extent", "o", [](const Call& c) { return extent(c, &Measure::Extent::high); }, false},
      {"min_extent", "o", [](const Call& c) { return extent(c, &Measure::Extent::low); }, false},
      {"trace", "ovv|t", trace, false},
  };
}

}  // namespace vestige::lang
