// SPDX-License-Identifier: Apache-2.0
// Services of the engine for a plugin's constructor: files, images, messages, plugins inside
// plugins.
#pragma once
#include <memory>
#include <stdexcept>
#include <string>

#include <vestige/brdf.h>
#include <vestige/pigment.h>

namespace vestige {

enum class Wrap { repeat, clamp, mirror };

struct TextureRequest {
  std::string file;         ///< as written in the scene
  Span span;                ///< of that name: it is looked for beside the text that names it
  std::string colourSpace;  ///< "" by the file's own metadata; "raw" for data
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
};

/// An image in rendering space. v = 0 at the bottom row, texel centres at (i + 0.5) / n.
/// Footprints: two vectors, each as long as the whole of a uniform segment, so the filter has the
/// covariance (a a^T + b b^T) / 12 in uv: that of a box over the parallelogram they span.
class Texture {
 public:
  virtual ~Texture() = default;
  /// The average of the point lookups under the footprint, channel by channel in linear light
  /// (colour is not weighted by alpha, as in mean()) [any thread]. Zero vectors give the bilinear
  /// point lookup. The result is the same, to the bit, if the footprint's longest axis (the root of
  /// the larger eigenvalue of a a^T + b b^T) is within one texel, or is NaN. Between one and two
  /// texels the point and the filtered value are blended. Beyond an aspect of 32 the shorter axis
  /// is widened; beyond 16 times the picture each axis is clamped.
  virtual Rgba lookup(Vec2 uv, const Vec2 dUv[2]) const noexcept = 0;
  /// One texel of the full resolution; x, y inside the image, row 0 at the bottom [any thread].
  virtual Rgba texel(int x, int y) const noexcept = 0;
  virtual int width() const noexcept = 0;
  virtual int height() const noexcept = 0;
  virtual bool hasAlpha() const noexcept = 0;
  /// Average of all texels.
  virtual Rgba mean() const noexcept = 0;
};

class Medium;
class PhaseFunction;

/// A BRDF inside another, evaluated at the same point. Its inputs follow those of the owner.
struct NestedBrdf {
  std::shared_ptr<const Brdf> brdf;  ///< never null
  int firstInput = 0;                ///< counted from the owner's first

  /// The owner's point with the nested BRDF's inputs.
  ScatterPoint at(ScatterPoint p) const noexcept {
    p.inputs = p.inputs.from(firstInput);
    return p;
  }
};

/// Passed to a plugin's constructor. [main thread]
class Host {
 public:
  virtual ~Host() = default;
  /// Absolute path of a file beside the scene text of `span`, or "" with the searched places in
  /// `error`. Call it for every file before reading it, also for files that other files name: a
  /// preview watches these files, and creates a shape again only if one of them has changed.
  virtual std::string find(const std::string& file, Span span, std::string& error) = 0;
  /// The image, read only once for all requests; null with the reason in `error`.
  virtual std::shared_ptr<const Texture> texture(const TextureRequest& request,
                                                 std::string& error) = 0;
  /// Creates the BRDF of a block inside the caller's own. Never null: if the block is refused, the
  /// error is reported and the scene is not rendered. The nested BRDF's inputs may be textured; its
  /// owner evaluates it at NestedBrdf::at(point). A null block gives a grey diffuse BRDF.
  virtual NestedBrdf brdf(const Block* /*block*/) { return unavailable(); }
  /// Creates a pigment, with the transforms written inside its block.
  virtual std::shared_ptr<const Pigment> pigment(const Block& /*block*/) { return unavailable(); }
  virtual std::shared_ptr<const Medium> medium(const Block& /*block*/) { return unavailable(); }
  virtual std::shared_ptr<const PhaseFunction> phase(const Block& /*block*/) {
    return unavailable();
  }

  /// Warns the user of something that does not stop the render.
  virtual void warn(Span span, const std::string& message) = 0;
  /// Tells the user something that is not a mistake. Equal messages are shown once.
  virtual void note(const std::string& /*message*/) {}

 private:
  /// Result of the defaults above, for test hosts that create no plugins.
  struct Unavailable {
    template <class Anything>
    operator Anything() const {
      throw std::runtime_error("this host makes no plugins inside others");
    }
  };
  static Unavailable unavailable() { return {}; }
};

}  // namespace vestige
