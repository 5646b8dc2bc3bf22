// SPDX-License-Identifier: Apache-2.0
// Parallel projection: rays start on a rectangle perpendicular to the view, so objects behind
// `location` are invisible and size does not depend on distance.
#include <vestige/tools/view_frame.h>

namespace vestige {
namespace {

class Orthographic final : public Camera {
 public:
  enum Row { kWidth = kViewRows };

  static Schema schema() {
    return {.kind = "camera",
            .name = "orthographic",
            .summary = "parallel projection",
            .params =
                viewRows({real("width", 1)
                              .positive()
                              .in("scene units")
                              .doc("of what the picture shows, from its left to its right edge")})};
  }

  explicit Orthographic(const Values& values)
      : view_(viewFrame(values)), width_(values.real(kWidth) * view_.across) {
    if (!(width_ > 0))
      throw PluginError(kWidth,
                        "width is " + words(values.real(kWidth)) + ": expected more than 0");
  }

  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    const Mat3x2 du = perFilm(n.aspect);
    return CameraSample{view_.location + du * (n.film - Vec2{Real(0.5), Real(0.5)}), view_.forward};
  }

  Real pdf(Vec3, Vec3, Real) const noexcept override { return 0; }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    const Mat3x2 du = perFilm(n.aspect);
    return {.dOrigin = {du.c[0], du.c[1]}, .dDirection = {}};
  }

 private:
  /// How the origin moves per unit of film coordinate.
  Mat3x2 perFilm(Real aspect) const noexcept {
    return {width_ * view_.right, -width_ / aspect * view_.up};
  }

  ViewFrame view_;
  Real width_;  ///< world, scene units
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::Orthographic)
