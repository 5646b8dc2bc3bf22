// SPDX-License-Identifier: Apache-2.0
// A path through a real scene, made of its random numbers and nothing else, with differentials on
// request: the same path again with one number moved is the witness against them.
#pragma once
#include <vestige/footprint.h>

#include <vector>

#include "engine/scene/scene.h"
#include "support/judge.h"

namespace vestige::test {

/// Everything that decides a path. Pairs: camera film, camera lens, then one a scattering.
struct PathNumbers {
  std::vector<Vec2> pairs;
  std::vector<Real> lobes;  ///< discrete choices, never moved
};

/// Where the path stands on arrival at a vertex.
struct TracedVertex {
  Surface surface;
  Vec3 direction;  ///< D, of arrival
  Real logF = 0;   ///< log of the product of f cos so far, without specular events
  Interaction x;
  InputBuffer buffer;
  std::optional<ScatterSample> drawn;
};

/// Differentials on arrival at each vertex.
using PathDifferentials = Differentials<16>;  // room for all numbers: never reduced

class PathTracer {
 public:
  PathTracer(const Scene& scene, Real aspect) : scene_(scene), aspect_(aspect) {}

  /// Up to `vertices` of them. With `base`, only as far as the path meets the same surfaces and
  /// lobes as that one did, and with every lobe turned as base's without spin. With `carried`, the
  /// differentials on arrival at each vertex.
  std::vector<TracedVertex> trace(const PathNumbers& n, int vertices,
                                  const std::vector<TracedVertex>* base = nullptr,
                                  std::vector<PathDifferentials>* carried = nullptr,
                                  std::vector<PathFootprint<16>>* footprints = nullptr) const {
    std::vector<TracedVertex> path;
    path.reserve(std::size_t(vertices));
    const CameraNumbers film{n.pairs[0], n.pairs[1], aspect_};
    const auto start = scene_.camera().sample(film);
    if (!start) return path;
    PathFootprint<16> footprint;
    footprint.begin(scene_.camera().sampleDerivatives(film), start->direction,
                    scene_.camera().variables(), 0, 1, {});
    Ray ray{start->origin, start->direction, 0, kInfinity};
    Real logF = 0;
    for (int k = 0; k < vertices; ++k) {
      const auto hit = scene_.view().intersect(ray);
      if (!hit) break;
      if (base && (k >= int(base->size()) || !isSame(*hit, (*base)[std::size_t(k)].surface))) break;
      TracedVertex& v = path.emplace_back();
      v.surface = *hit, v.direction = ray.direction, v.logF = logF;
      v.x = scene_.view().shade(*hit, -ray.direction, {}, v.buffer);
      footprint.arrive(*hit, Real(1e9));
      if (carried) carried->push_back(footprint.differentials());
      if (footprints) footprints->push_back(footprint);
      const ScatterNumbers numbers{n.lobes[std::size_t(k)], n.pairs[std::size_t(k + 2)]};
      const TracedVertex* twin = base ? &(*base)[std::size_t(k)] : nullptr;
      if (!scatter(v, numbers, twin)) break;
      const Vec3 next = normalize(v.x.frame.toWorld(v.drawn->toNext));
      footprint.scatter(*hit, v.x, {next, {}, *v.drawn}, numbers);
      if (!v.drawn->specular)
        logF += std::log(luminance(v.x.brdf->f(v.x.point, v.drawn->toNext)) *
                         std::abs(v.drawn->toNext.z));
      // From the surface itself: a start off it would be another path.
      ray = {hit->position, next, kSkip, kInfinity};
    }
    return path;
  }

 private:
  static constexpr Real kSkip = Real(1e-3);  ///< nothing in these scenes is nearer to itself

  static bool isSame(const Surface& a, const Surface& b) {
    return a.object == b.object && a.primitive == b.primitive;
  }

  /// Draws v's continuation; false where there is none, or not within the lobe of the twin.
  bool scatter(TracedVertex& v, ScatterNumbers numbers, const TracedVertex* twin) const {
    if (!v.x.brdf) return false;
    v.drawn = v.x.brdf->sample(v.x.point, numbers);
    if (!v.drawn || (twin && (!twin->drawn || twin->drawn->lobe != v.drawn->lobe))) {
      v.drawn.reset();
      return false;
    }
    // Phong builds a frame around its lobe, which spins as the lobe moves; only a shift of the
    // random number, but one that differences would see. All other lobes stand in the shading
    // frame.
    if (twin && scene_.object(v.surface.object).brdf == "phong") {
      const auto before = lobeFrame(*v.x.brdf, twin->x.point, numbers.lobe);
      const auto now = lobeFrame(*v.x.brdf, v.x.point, numbers.lobe);
      if (!before || !now) return false;
      v.drawn->toNext =
          transport(before->n, now->n, before->toWorld(now->toLocal(v.drawn->toNext)));
    }
    return sidesAgree(v.x, v.x.frame.toWorld(v.drawn->toNext), v.drawn->toNext.z);
  }

  const Scene& scene_;
  Real aspect_;
};

}  // namespace vestige::test
