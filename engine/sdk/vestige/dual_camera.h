// SPDX-License-Identifier: Apache-2.0
// Base class of cameras that write the map from film to ray once, as a template, and inherit its
// derivatives.
//
//     class Fisheye final : public DualCamera<Fisheye> {
//      public:
//       explicit Fisheye(const Values& v) : DualCamera(viewFrame(v)) {}
//       template <class T>   // in the camera's own axes; the direction of any length
//       std::optional<TRay<T>> ray(const TVec2<T>& film, const TVec2<T>& lens,
//                                  Real aspect) const noexcept;
//     };
#pragma once
#include <vestige/dual.h>
#include <vestige/tools/view_frame.h>

namespace vestige {

/// The axes of ray() are right, up and forward; its origin is relative to the camera's location, in
/// world lengths (ViewFrame::across and along scale those of the scene text).
template <class Derived>
class DualCamera : public Camera {
 public:
  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    const auto r =
        self().ray(TVec2<Real>{n.film.x, n.film.y}, TVec2<Real>{n.lens.x, n.lens.y}, n.aspect);
    if (!r) return std::nullopt;
    return CameraSample{view_.location + turned(value(r->origin)),
                        normalize(turned(value(r->direction)))};
  }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    RayJacobian j;
    const TVec2<Dual> film{Dual::variable(n.film.x, 0), Dual::variable(n.film.y, 1)};
    const TVec2<Dual> lens{Dual::variable(n.lens.x, 2), Dual::variable(n.lens.y, 3)};
    const auto r = self().ray(film, lens, n.aspect);
    if (!r) return j;
    const TVec3<Dual> d = normalize(r->direction);
    for (int k = 0; k < 4; ++k) {
      j.dOrigin[k] = turned(derivative(r->origin, k));
      j.dDirection[k] = turned(derivative(d, k));
    }
    return j;
  }

 protected:
  explicit DualCamera(const ViewFrame& view) : view_(view) {}

  const ViewFrame& view() const noexcept { return view_; }
  /// A world direction in the camera's axes.
  Vec3 inView(Vec3 d) const noexcept {
    return {dot(d, view_.right), dot(d, view_.up), dot(d, view_.forward)};
  }

 private:
  Vec3 turned(Vec3 v) const noexcept {
    return v.x * view_.right + v.y * view_.up + v.z * view_.forward;
  }
  const Derived& self() const noexcept { return static_cast<const Derived&>(*this); }

  ViewFrame view_;
};

}  // namespace vestige
