// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/inputs.h>

#include <optional>

/// Colour that varies over a surface: image maps and procedural patterns.
///
/// Conventions of every method:
///   * A pigment is evaluated in its own space. The engine has undone the transforms of the scene:
///     all of them for `position`, those inside the pigment's own braces for `uv`.
///   * A footprint is two differential vectors, each the full length of a uniform segment. The
///     result is the average under a filter of covariance (a a^T + b b^T) / 12, that of a box over
///     their parallelogram. Zero vectors mean a point lookup. A footprint whose longest axis is
///     within one texel gives exactly the point's value.
///   * Colours are linear, in rendering space; alpha 1 is opaque; not premultiplied.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// The region of a surface that one path stands for, at one point. Two differential vectors; all
/// zero where the path carries no differentials.
struct Footprint {
  Vec3 dP[2];               ///< scene units, in the tangent plane
  Vec2 dUv[2];              ///< the same two vectors as changes of uv
  bool alongMajor = false;  ///< images are filtered as in PD01 (tools/texture_box.h)
  bool isPoint() const noexcept {
    return lengthSquared(dP[0]) + lengthSquared(dP[1]) == 0 &&
           dot(dUv[0], dUv[0]) + dot(dUv[1], dUv[1]) == 0;
  }
};

/// The place at which a pigment is evaluated.
struct Lookup {
  Vec3 position;        ///< solid patterns and projected images
  Vec2 uv;              ///< image maps
  Footprint footprint;  ///< in the same spaces as position and uv
};

/// The value of a pattern before a map turns it into a colour: a number in [0,1], as in POV-Ray.
/// Its mean and spread over the footprint allow the map to be averaged too.
struct PatternValue {
  Real mean;    ///< [0,1]
  Real spread;  ///< standard deviation over the footprint; 0 at a point
};

class Pigment {
 public:
  virtual ~Pigment() = default;

  /// The colour, averaged over the footprint.
  virtual Rgba eval(const Lookup& at) const noexcept = 0;

  /// The mean colour over one period, for bounds and infinite footprints; grey 0.5 if unknown.
  virtual Rgba mean() const noexcept { return {grey(Real(0.5)), 1}; }

  /// The pattern behind the colours; nullopt: the pigment has none (an image).
  virtual std::optional<PatternValue> pattern(const Lookup&) const noexcept { return std::nullopt; }

  /// Number of texels per unit of u and of v, <0,0> if there are none: `inspect` prints footprints
  /// in texels.
  virtual Vec2 texels() const noexcept { return {}; }
};

}  // namespace vestige
