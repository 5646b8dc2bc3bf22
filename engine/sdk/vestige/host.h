// SPDX-License-Identifier: Apache-2.0
// What the engine does for a plugin while it is created: files, images, messages.
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
  /// (colour is not weighted by alpha, as in mean()) [any thread]. Zero vectors ask for a point,
  /// which is bilinear; so, to the bit, does any footprint whose longest axis, the root of the
  /// larger eigenvalue of a a^T + b b^T, is within one texel, and one that is not a number. Up to
  /// two texels both are mixed, so nothing jumps. Beyond an aspect of 32 the shorter axis is
  /// widened, beyond 16 times the picture each axis is cut.
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

/// A BRDF inside another, which asks it at its own point. Its inputs follow those of the owner.
struct NestedBrdf {
  std::shared_ptr<const Brdf> brdf;  ///< never null
  int firstInput = 0;                ///< counted from the owner's first

  /// The owner's point, with the inputs of this one.
  ScatterPoint at(ScatterPoint p) const noexcept {
    p.inputs = p.inputs.from(firstInput);
    return p;
  }
};

/// Handed to a plugin's constructor. [main thread]
class Host {
 public:
  virtual ~Host() = default;
  /// Absolute name of a file that stands beside the text of `span`, or "" with `error` saying where
  /// it was looked for. To be asked for every file before it is read, also one that another file
  /// names: what was asked for is watched by a preview, which creates a shape again only when such
  /// a file has changed.
  virtual std::string find(const std::string& file, Span span, std::string& error) = 0;
  /// The image, read once however often it is asked for; null with `error` saying why.
  virtual std::shared_ptr<const Texture> texture(const TextureRequest& request,
                                                 std::string& error) = 0;
  /// A plugin made of a block inside the caller's own. Never null: where the block is refused, the
  /// user has been told and the scene is not rendered. A BRDF's inputs may be textured; its owner
  /// hands its points on by NestedBrdf::at(). Null block: a grey diffuse one.
  virtual NestedBrdf brdf(const Block* /*block*/) { return unavailable(); }
  /// A pigment with the transforms written inside its block.
  virtual std::shared_ptr<const Pigment> pigment(const Block& /*block*/) { return unavailable(); }
  virtual std::shared_ptr<const Medium> medium(const Block& /*block*/) { return unavailable(); }

  /// Something the user should know that does not stop the render.
  virtual void warn(Span span, const std::string& message) = 0;
  /// Something worth knowing that is not a mistake. The same message is shown once.
  virtual void note(const std::string& /*message*/) {}

 private:
  /// For hosts of tests that make no plugins.
  struct Unavailable {
    template <class Anything>
    operator Anything() const {
      throw std::runtime_error("this host makes no plugins inside others");
    }
  };
  static Unavailable unavailable() { return {}; }
};

}  // namespace vestige
