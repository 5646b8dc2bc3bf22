// SPDX-License-Identifier: Apache-2.0
// Box along the axes. Each face carries uv in [0,1]^2, upright and readable from outside: u to the
// right, v up (on the lid and the floor: v towards +z).
#include <vestige/plugin.h>

#include "exact.h"

namespace vestige {
namespace {

class Box final : public Shape {
 public:
  enum Row { kCorner1, kCorner2 };

  static Schema schema() {
    return {
        .kind = "shape",
        .name = "box",
        .summary = "between two opposite corners, along the axes",
        .params = {vec3("corner1", {}).need().place().in("scene units").doc("one corner"),
                   vec3("corner2", {}).need().place().in("scene units").doc("the corner across")}};
  }
  explicit Box(const Values& v)
      : b_{minimum(v.vec3(kCorner1), v.vec3(kCorner2)),
           maximum(v.vec3(kCorner1), v.vec3(kCorner2))} {
    const Vec3 size = b_.size();
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
      throw PluginError(kCorner2,
                        "the box is flat: its corners must differ in x, y and z (a flat rectangle "
                        "is a quad)");
    double sum = 0;
    for (int f = 0; f < 6; ++f) sums_[f] = sum += faceArea(f);
  }

  Bounds bounds() const noexcept override { return b_; }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const std::optional<Chord> c = chord(ray);
    if (!c) return std::nullopt;
    if (exact::within(c->in, ray)) return ShapeHit{Real(c->in), c->inFace};
    if (exact::within(c->out, ray)) return ShapeHit{Real(c->out), c->outFace};
    return std::nullopt;
  }
  int crossings(const Ray& ray, std::span<Crossing> found) const noexcept override {
    const std::optional<Chord> c = chord(ray);
    if (!c) return 0;
    return exact::interval({Real(c->in), c->inFace}, c->in, {Real(c->out), c->outFace}, c->out, ray,
                           found);
  }

  SurfacePoint surface(Vec3 near, const ShapeHit& hit) const noexcept override {
    const int face = hit.part;
    const Face f = faceOf(face);
    const auto part = [&](int k, bool back) {
      const Real x = std::clamp((near[k] - b_.low[k]) / b_.size()[k], Real(0), Real(1));
      return back ? 1 - x : x;
    };
    SurfacePoint s = at({part(f.u, f.mirrored), part(f.v, false)}, face);
    for (const int k : {f.u, f.v}) s.position[k] = std::clamp(near[k], b_.low[k], b_.high[k]);
    return s;
  }

  bool isClosed() const noexcept override { return true; }
  Real area() const noexcept override { return Real(sums_[5]); }

  AreaSample samplePoint(Vec2 u) const noexcept override {
    const double x = u.x * sums_[5];
    int f = 0;
    while (f < 5 && x >= sums_[f]) ++f;
    const double low = f > 0 ? sums_[f - 1] : 0, width = sums_[f] - low;
    const SurfacePoint p = at({Real((x - low) / width), u.y}, f);
    return {p, {Real(sums_[5] / width) * p.dPdu, p.dPdv}, {}, 1 / area()};
  }

  int faces() const noexcept override { return 6; }
  SurfacePoint at(Vec2 uv, int face) const noexcept override {
    const Face f = faceOf(face);
    const Vec3 size = b_.size();
    SurfacePoint s;
    const Real x = f.mirrored ? 1 - uv.x : uv.x;
    s.position[f.axis] = f.outer ? b_.high[f.axis] : b_.low[f.axis];
    s.position[f.u] = b_.low[f.u] + x * size[f.u];
    s.position[f.v] = b_.low[f.v] + uv.y * size[f.v];
    s.geometricNormal[f.axis] = f.outer ? Real(1) : Real(-1);
    s.normal = s.geometricNormal;
    s.uv = uv;
    s.dPdu[f.u] = f.mirrored ? -size[f.u] : size[f.u];
    s.dPdv[f.v] = size[f.v];
    return s;
  }

 private:
  /// The part of a ray's line that is inside, by t, and the faces at its ends.
  struct Chord {
    double in, out;
    int inFace, outFace;
  };
  std::optional<Chord> chord(const Ray& ray) const noexcept {
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    int inFace = 0, outFace = 0;
    for (int k = 0; k < 3; ++k) {
      const double o = ray.origin[k], d = ray.direction[k];
      if (d == 0) {
        if (o < b_.low[k] || o > b_.high[k]) return std::nullopt;
        continue;
      }
      const bool up = d > 0;
      const double a = ((up ? b_.low[k] : b_.high[k]) - o) / d;
      const double b = ((up ? b_.high[k] : b_.low[k]) - o) / d;
      if (a > in) in = a, inFace = 2 * k + !up;
      if (b < out) out = b, outFace = 2 * k + up;
    }
    if (!(in <= out)) return std::nullopt;
    return Chord{in, out, inFace, outFace};
  }

  /// Face 2 k is the low one of axis k, 2 k + 1 the high one.
  struct Face {
    int axis, u, v;
    bool outer, mirrored;  ///< u runs against its axis
  };
  static Face faceOf(int face) noexcept {
    const int axis = face / 2;
    const bool outer = face % 2 == 1;
    if (axis == 0) return {0, 2, 1, outer, !outer};
    if (axis == 1) return {1, 0, 2, outer, !outer};
    return {2, 0, 1, outer, outer};
  }
  double faceArea(int face) const noexcept {
    const Face f = faceOf(face);
    return double(b_.size()[f.u]) * b_.size()[f.v];
  }

  Bounds b_;
  double sums_[6];  ///< areas of the faces up to and including each
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Box)
