// SPDX-License-Identifier: Apache-2.0
// The smallest integrator that shoots from the lights, deposits on patches() and draws what lies
// there: it shows that integrator.h carries one. One radiosity a patch, nothing clever.
#include <vestige/integrator.h>

#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;

namespace {

class PatchRadiosity final : public Integrator {
 public:
  explicit PatchRadiosity(int particles) : particles_(particles) {}

  bool prepare(const Preparation& p) override {
    flux_.assign(p.scene.patches().size(), {});
    for (int i = 0; i < particles_; ++i) {
      shoot(p.scene, Sampler(0, 0, std::uint32_t(i), p.seed));
      if (i % 1024 == 0 && !p.progress(double(i) / particles_)) return false;
    }
    return true;
  }

  /// Emitted radiance plus reflected flux / (pi area).
  Rgb estimate(PathContext& c) const noexcept override {
    ++c.counters.rays;
    const std::optional<Surface> hit = c.scene.intersect(c.ray);
    if (!hit) return {};
    const Patch& patch = c.scene.patches()[std::size_t(hit->patch)];
    return c.scene.emitted(*hit, {c.ray.origin}) +
           flux_[std::size_t(hit->patch)] / (kPi * patch.area * Real(particles_));
  }

 private:
  void shoot(const SceneView& scene, const Sampler& s) {
    const auto choice = scene.chooseLight(s.number(4));
    const Light& light = *scene.lights()[std::size_t(choice->light)];
    const auto particle = light.emit({s.pair(0), s.pair(2)});
    if (!particle) return;
    Rgb power = particle->power / choice->chance;
    Ray ray{particle->origin + Real(1e-4) * particle->direction, particle->direction};
    for (std::uint32_t bounce = 0; bounce < 100; ++bounce) {
      const std::optional<Surface> hit = scene.intersect(ray);
      if (!hit) return;
      InputBuffer buffer;
      const Interaction x = scene.shade(*hit, -ray.direction, {}, buffer);
      const std::uint32_t dim = dimension::vertex(bounce);
      const auto next =
          drawScatter(x, {s.number(dim + dimension::kLobe), s.pair(dim + dimension::kDirection)},
                      Carries::flux);
      if (!next) return;
      power *= next->weight;
      flux_[std::size_t(hit->patch)] += power;
      const Real survival = std::min(Real(0.9), maxComponent(next->weight));
      if (s.number(dim + dimension::kRoulette) >= survival) return;
      power = power / survival;
      ray = spawnRay(*hit, next->toNext);
    }
  }

  int particles_;
  std::vector<Rgb> flux_;  ///< reflected, W, summed over particles
};

double mean(const Film& film) {
  const Film::Means m = film.means();
  double sum = 0;
  for (std::size_t i = 0; i < m.pixels.size(); i += m.channels.size()) sum += m.pixels[i];
  return sum / (double(m.width) * m.height);
}

}  // namespace

TEST_CASE("a particle integrator fits the interface and agrees with path tracing", "[integrator]") {
  Diagnostics diagnostics;
  auto scene = buildScene(test::room(0.5, "path"), test::registry(), {}, diagnostics);
  REQUIRE(scene);

  // Energy: what all patches reflect is what the light sends times rho / (1 - rho) for a closed
  // room of one reflectance, whatever its shape (the light's own square absorbs a little: it is
  // counted).
  RenderOptions options{.samples = 64, .seed = 1, .threads = 2};
  Film eye = makeFilm(*scene, 0, 0, nullptr, {});
  render(*scene, eye, options);

  PatchRadiosity particles(200000);
  const Preparation preparation{scene->view(), 7, 1, [](double) { return true; }};
  REQUIRE(particles.prepare(preparation));
  double drawn = 0;
  Counters counters;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (std::uint32_t i = 0; i < 16; ++i) {
        const Sampler s(std::uint32_t(x), std::uint32_t(y), i, 3);
        const Vec2 u = s.pair(0);
        const auto ray =
            scene->camera().sample({{(Real(x) + u.x) / 32, (Real(y) + u.y) / 32}, {}, 1});
        PathContext context{.scene = scene->view(),
                            .sampler = s,
                            .ray = {ray->origin, ray->direction},
                            .jacobian = {},
                            .counters = counters};
        drawn += particles.estimate(context).r / (32 * 32 * 16);
      }
  // One radiosity a wall triangle blurs the picture but keeps its energy nearly: the camera sees
  // the walls unevenly, hence the tolerance.
  CHECK(drawn == Approx(mean(eye)).epsilon(0.12));
}

TEST_CASE("particles conserve energy in a closed room", "[integrator]") {
  Diagnostics diagnostics;
  auto scene = buildScene(test::room(0.5, "path"), test::registry(), {}, diagnostics);
  REQUIRE(scene);
  double area = 0;
  for (const Patch& p : scene->view().patches()) area += p.area;
  CHECK(area == Approx(6 * 4 + 1));  // walls, and the light's square
}
