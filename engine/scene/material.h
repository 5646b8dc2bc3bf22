// SPDX-License-Identifier: Apache-2.0
// A BRDF with its inputs: constants, and pigments with the spaces that they live in.
#pragma once
#include <vestige/brdf.h>
#include <vestige/integrator.h>
#include <vestige/pigment.h>

#include <memory>
#include <vector>

namespace vestige {

/// A pigment at its place in the scene.
struct PlacedPigment {
  std::shared_ptr<const Pigment> pigment;
  Affine fromScene;  ///< undoes all transforms: takes positions that SceneView gives
  Affine fromUv;     ///< undoes the pigment's own: for uv
  /// The pigment at a point of a surface, averaged over a footprint (world space, uv).
  Rgba eval(const SurfacePoint& at, const Footprint& footprint) const noexcept;
  /// The same from a lookup in the space that `fromScene` and `fromUv` lead out of.
  Rgba eval(const Lookup& outside) const noexcept { return pigment->eval(inside(outside)); }
  Lookup inside(const Lookup& outside) const noexcept;
  /// Texels that a unit of the surface's uv spans.
  Vec2 texels() const noexcept;
};

struct Material {
  struct TexturedInput {
    int input;
    bool isReal;      ///< takes the luminance
    bool isFiltered;  ///< over the footprint; else looked up at the point
    Real low, high;   ///< the schema's range, which a texture may not leave either
    PlacedPigment pigment;
  };

  std::shared_ptr<const Brdf> brdf;  ///< null: reflects nothing
  int inputs = 0;                    ///< how many there are
  InputBuffer constants{};           ///< of every input; textured ones hold their mean
  std::vector<TexturedInput> textured;
  int normalMap = -1, opacity = -1;  ///< indices of these inputs
  int refractiveIndex = -1;          ///< of the inside; -1: light passes as through air, if at all
  bool isDielectric = false;         ///< light is refracted to the far side
  int priority = 0;                  ///< of a solid of it, against others at the same place
  Rgb absorption;                    ///< inside such a solid, 1 per scene unit
  bool hasNormalMap = false;
  Real cutoff = -1;            ///< opacity below it is 0, else 1; below 0: it is as it is
  bool isTranslucent = false;  ///< opacity may be below 1
  bool usesFootprint = false;  ///< some input is filtered

  /// Refractive index of the inside; the mean where it is textured.
  Real meanIndex() const noexcept { return indexOf(Inputs(constants.data())); }
  Real indexOf(const Inputs& evaluated) const noexcept;
  /// Whether sample() ever draws a direction on the far side, with the mean of each input.
  bool transmits() const noexcept;
  /// Texels of the finest texture, a unit of uv; <0, 0> without one.
  Vec2 texels() const noexcept;
  /// Opacity alone, for shadow rays.
  Rgb opacityAt(const SurfacePoint& at) const noexcept;
  /// An opacity as it was looked up, with the range and the cutoff applied.
  Rgb cut(Rgb opacity) const noexcept;
  /// Looks the inputs up; constants are not copied where nothing is textured.
  Inputs evaluate(const SurfacePoint& at, const Footprint& footprint,
                  InputBuffer& buffer) const noexcept {
    return textured.empty() ? Inputs(constants.data()) : lookUp(at, footprint, buffer);
  }
  Inputs lookUp(const SurfacePoint& at, const Footprint& footprint,
                InputBuffer& buffer) const noexcept;
};

/// Everything a BRDF needs at a surface, seen along toPrev [SDK: brdf.h says which way it faces].
/// `indices`: refractive indices of the scene's solids by number; of 0, air's.
void interact(const Material& material, const Surface& surface, Vec3 toPrev,
              const Footprint& footprint, const Real* indices, InputBuffer& buffer,
              Interaction& result) noexcept;

}  // namespace vestige
