// SPDX-License-Identifier: Apache-2.0
// Schemas of solids, and what the shapes of a scene that is read with them extend to and hold.
#pragma once
#include <cmath>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {

inline const SchemaSource& solids() {
  static const vestige::test::SchemaList all = [] {
    const auto point = [](const char* name) { return vec3(name, {}).need().place(); };
    const auto length = [](const char* name) { return real(name, 1).need().place(); };
    std::vector<Schema> s;
    s.push_back({"shape", "sphere", "", {point("centre"), length("radius")}});
    s.push_back({"shape", "box", "", {point("a"), point("b")}});
    s.push_back({"shape", "cylinder", "", {point("a"), point("b"), length("r")}});
    s.push_back({"shape", "cone", "", {point("a"), length("r"), point("b"), length("s")}});
    s.push_back({"shape", "torus", "", {length("big"), length("r")}});
    s.push_back({"shape", "plane", "", {point("normal"), real("distance", 0).place()}});
    s.push_back({"shape", "triangle", "", {point("a"), point("b"), point("c")}});
    s.push_back({"union", "", "", {}, {}, {"shape", "union"}});
    for (Schema& each : s) each.standsAlone = each.isMovable = true;
    return vestige::test::SchemaList(s);
  }();
  return all;
}

struct Extents {
  double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
};

inline double number(const Block& b, const char* name) {
  return b.find(name) ? b.find(name)->v[0] : 0;
}

/// Grows by a disc, a ball (no normal) or a point, around a place in the block's own space.
inline void grow(Extents& e, const Block& b, const double* at, const double* normal, double radius,
                 double pad) {
  const auto& m = b.world.m;
  double n[3] = {0, 0, 0}, length = 0;
  for (int i = 0; i < 3 && normal; ++i) {
    for (int k = 0; k < 3; ++k) n[i] += m[std::size_t(i)][std::size_t(k)] * normal[k];
    length += n[i] * n[i];
  }
  for (int i = 0; i < 3; ++i) {
    const auto& row = m[std::size_t(i)];
    const double c = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
    const double scale = std::hypot(row[0], row[1], row[2]);
    const double cosine2 = length > 0 ? n[i] * n[i] / length : 0;
    const double r = radius * std::sqrt(std::max(0.0, 1 - cosine2)) * scale + pad * scale;
    e.low[i] = std::min(e.low[i], c - r), e.high[i] = std::max(e.high[i], c + r);
  }
}

inline void addBox(Extents& e, const Block& b) {
  for (int corner = 0; corner < 8; ++corner) {
    double at[3];
    for (int i = 0; i < 3; ++i) at[i] = b.find(corner >> i & 1 ? "a" : "b")->v[i];
    grow(e, b, at, nullptr, 0, 0);
  }
}

inline void add(Extents& e, const Block& b) {
  for (const Block& child : b.children) add(e, child);
  if (b.kind != "shape") return;
  const double origin[3] = {0, 0, 0}, up[3] = {0, 1, 0};
  if (b.plugin == "torus") return grow(e, b, origin, up, number(b, "big"), number(b, "r"));
  if (b.plugin == "box") return addBox(e, b);
  if (b.plugin == "sphere") return grow(e, b, b.find("centre")->v, nullptr, 0, number(b, "radius"));
  const bool isRound = b.plugin == "cylinder" || b.plugin == "cone";
  double axis[3] = {0, 0, 0};
  for (int i = 0; i < 3 && isRound; ++i) axis[i] = b.find("b")->v[i] - b.find("a")->v[i];
  const double* const normal = isRound ? axis : nullptr;
  const double last = b.plugin == "cone" ? number(b, "s") : number(b, "r");
  grow(e, b, b.find("a")->v, normal, number(b, "r"), 0);
  if (b.find("b")) grow(e, b, b.find("b")->v, normal, last, 0);
  if (b.find("c")) grow(e, b, b.find("c")->v, nullptr, 0, 0);
}

/// Whether a point lies in a box, a cylinder or a union of them.
inline bool holds(const Block& b, const double* point) {
  for (const Block& child : b.children)
    if (holds(child, point)) return true;
  if (b.kind != "shape") return false;
  const Affine inverse = b.world.inverse();
  const auto& m = inverse.m;
  double p[3], along = 0, length2 = 0, far2 = 0;
  bool isBetween = true;
  const auto &from = b.find("a")->v, &to = b.find("b")->v;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = m[i][0] * point[0] + m[i][1] * point[1] + m[i][2] * point[2] + m[i][3];
    isBetween &= p[i] >= std::min(from[i], to[i]) && p[i] <= std::max(from[i], to[i]);
    along += (p[i] - from[i]) * (to[i] - from[i]);
    length2 += (to[i] - from[i]) * (to[i] - from[i]);
  }
  if (b.plugin == "box") return isBetween;
  const double share = along / length2, r = number(b, "r");
  for (int i = 0; i < 3; ++i) {
    const double off = p[i] - from[i] - share * (to[i] - from[i]);
    far2 += off * off;
  }
  return share >= 0 && share <= 1 && far2 <= r * r;
}

}  // namespace vestige::lang::test
