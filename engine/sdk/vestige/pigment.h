// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/inputs.h>

#include <optional>

/// Colour that varies over a surface: image maps and procedural patterns.
///
/// Said once, true of every method:
///   * A pigment is asked in its own space: transforms of the scene were undone by the engine, for
///     `position` all of them, for `uv` those written inside the pigment's own braces.
///   * A footprint is two differential vectors, each the full length of a uniform segment: what is
///     asked for is the average under a filter of covariance (a a^T + b b^T) / 12, which a box over
///     their parallelogram has. Zero vectors ask for a point. A footprint whose longest axis is
///     within one texel gives exactly the point's value.
///   * Colours are linear, in rendering space; alpha 1 is opaque; not premultiplied.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// The region of a surface that one path stands for, at one point. Two differential vectors; all
/// zero where the path carries no differentials.
struct Footprint {
  Vec3 dP[2];               ///< scene units, in the tangent plane
  Vec2 dUv[2];              ///< the same two vectors as changes of uv
  bool alongMajor = false;  ///< pictures are to be looked up as PD01 does (tools/texture_box.h)
  bool isPoint() const noexcept {
    return lengthSquared(dP[0]) + lengthSquared(dP[1]) == 0 &&
           dot(dUv[0], dUv[0]) + dot(dUv[1], dUv[1]) == 0;
  }
};

/// Where a pigment is asked.
struct Lookup {
  Vec3 position;        ///< solid patterns and projected images
  Vec2 uv;              ///< image maps
  Footprint footprint;  ///< in the same spaces as position and uv
};

/// What a pattern is before it becomes a colour: POV-Ray's number in [0,1], which a map turns into
/// colours. Its mean over the footprint and how far it spreads there: so a map can be averaged over
/// what the footprint sees.
struct PatternValue {
  Real mean;    ///< [0,1]
  Real spread;  ///< standard deviation over the footprint; 0 at a point
};

class Pigment {
 public:
  virtual ~Pigment() = default;

  /// The colour, averaged over the footprint.
  virtual Rgba eval(const Lookup& at) const noexcept = 0;

  /// Its mean over one period, for bounds and for what a footprint of no end would see; grey 0.5 if
  /// the pigment cannot tell.
  virtual Rgba mean() const noexcept { return {grey(Real(0.5)), 1}; }

  /// The pattern behind the colours; nullopt: the pigment has none (an image).
  virtual std::optional<PatternValue> pattern(const Lookup&) const noexcept { return std::nullopt; }

  /// Texels along u and v that one unit of uv spans, <0,0> where there are none: `inspect` speaks
  /// of footprints in texels.
  virtual Vec2 texels() const noexcept { return {}; }
};

}  // namespace vestige
