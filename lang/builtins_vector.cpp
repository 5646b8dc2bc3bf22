// SPDX-License-Identifier: Apache-2.0
// Functions of vectors and arrays. vrotate and vaxis_rotate take degrees, as POV-Ray's do.
#include <cmath>

#include "lang/builtins.h"
#include "lang/transforms.h"

namespace vestige::lang {
namespace {

double dot3(const Numbers& a, const Numbers& b) {
  return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

Datum crossProduct(const Call& c) {
  const auto a = c.vector(0).v, b = c.vector(1).v;
  return Numbers(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

Datum normalise(const Call& c) {
  const Numbers a = c.vector(0);
  const double l = std::sqrt(dot3(a, a));
  if (l == 0) {
    c.warn(0, "vnormalize() of a vector without length gives <0, 0, 0>");
    return Numbers(0, 0, 0);
  }
  return Numbers(a.v[0] / l, a.v[1] / l, a.v[2] / l);
}

Datum moved(const Affine& a, const Numbers& p) {
  double q[3];
  for (int i = 0; i < 3; ++i) q[i] = a.m[i][0] * p.v[0] + a.m[i][1] * p.v[1] + a.m[i][2] * p.v[2];
  return Numbers(q[0], q[1], q[2]);
}

Datum rotateAxis(const Call& c) {
  const Numbers axis = c.vector(1);
  if (dot3(axis, axis) == 0) c.warn(1, "vaxis_rotate() around <0, 0, 0> has no value");
  return moved(rotationAround(axis, c.number(2)), c.vector(0));
}

Datum dimensions(const Call& c) {
  return Numbers(double(std::get<ArrayPtr>(c.args[0])->sizes.size()));
}

Datum dimensionSize(const Call& c) {
  const auto& sizes = std::get<ArrayPtr>(c.args[0])->sizes;
  const int i = c.integer(1);
  if (i < 1 || std::size_t(i) > sizes.size()) return Numbers(0);  // as in POV-Ray
  return Numbers(sizes[std::size_t(i - 1)]);
}

}  // namespace

std::vector<Builtin> vectorBuiltins() {
  return {
      {"dimension_size", "an", dimensionSize},
      {"dimensions", "a", dimensions},
      {"vaxis_rotate", "vvn", rotateAxis},
      {"vcross", "vv", crossProduct},
      {"vdot", "vv",
       [](const Call& c) -> Datum { return Numbers(dot3(c.vector(0), c.vector(1))); }},
      {"vlength", "v",
       [](const Call& c) -> Datum { return Numbers(std::sqrt(dot3(c.vector(0), c.vector(0)))); }},
      {"vnormalize", "v", normalise},
      {"vrotate", "vv", [](const Call& c) { return moved(rotation(c.vector(1)), c.vector(0)); }},
  };
}

}  // namespace vestige::lang
