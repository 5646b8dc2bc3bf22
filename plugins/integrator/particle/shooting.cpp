// SPDX-License-Identifier: Apache-2.0
#include "shooting.h"

#include <vestige/tools/layers.h>

#include <exception>
#include <thread>

namespace vestige::particle {
namespace {

/// Dimensions of a particle's random numbers: a point of a light, a direction, which light; then as
/// paths.
constexpr std::uint32_t kPoint = dimension::kFilm, kDirection = dimension::kLens,
                        kLight = dimension::kTime;
/// Far from those of any vertex.
constexpr std::uint32_t kRounding = 0x70000000u;

/// What a thread takes at once.
constexpr std::uint64_t kBatch = 256;

/// From this scattering on survival is never certain: particles end even between white walls.
constexpr int kMortalFrom = 16;
constexpr Real kMaxSurvival = Real(0.95);

void add(Flux& sum, const Flux& f, std::int64_t sign = 1) noexcept {
  for (std::size_t c = 0; c < 3; ++c) sum[c] += sign * f[c];
}

/// Off the light's surface, so that rounding cannot meet it again.
Ray start(const Particle& p, Real size) noexcept {
  const Real step = 8 * std::numeric_limits<float>::epsilon() * (maxAbsComponent(p.origin) + size);
  const Real side = dot(p.direction, p.normal) < 0 ? Real(-1) : Real(1);
  return {p.origin + side * step * p.normal, p.direction, 0, kInfinity};
}

/// What arrives, as the shading normal sees it: E of a bent surface is not E of the flat one.
Real bending(const Interaction& x) noexcept {
  const Real flat = std::abs(dot(x.toPrev, x.geometricNormal));
  const Real bent = std::abs(dot(x.toPrev, x.frame.n));
  return bent == flat ? 1 : std::min(bent / std::max(flat, Real(1e-6)), Real(100));
}

Real areaOf(const PathFootprint<>& f, FootprintArea kind) noexcept {
  if (kind == FootprintArea::polygon) return f.area();
  const Footprint region = f.footprint();
  return length(cross(region.dP[0], region.dP[1]));
}

}  // namespace

void Booking::add(const Booking& b) noexcept {
  particle::add(emitted, b.emitted), particle::add(absorbed, b.absorbed);
  particle::add(escaped, b.escaped), particle::add(lost, b.lost), particle::add(gained, b.gained);
  particles += b.particles, hits += b.hits;
}

double totalPower(const SceneView& scene) noexcept {
  double rgb[3] = {};
  for (const Light* l : scene.lights()) {
    const Rgb p = l->power();
    rgb[0] += double(p.r), rgb[1] += double(p.g), rgb[2] += double(p.b);
  }
  return std::max({rgb[0], rgb[1], rgb[2]});
}

Flux Shooting::inUnits(Rgb watt, Real u) const noexcept {
  const double scale = 1 / (power * kFluxUnit);
  const auto rounded = [&](Real x) {
    const double n = std::floor(double(x) * scale + double(u));
    return std::isfinite(n) ? std::int64_t(std::clamp(n, -0x1p60, 0x1p60)) : 0;
  };
  return {rounded(watt.r), rounded(watt.g), rounded(watt.b)};
}

void Shooting::pass(std::uint64_t first, std::uint64_t last, int threads, Booking& booking) const {
  std::atomic<std::uint64_t> next{first};
  std::exception_ptr failure;  // only memory can run out
  std::mutex mutex;
  const auto work = [&] {
    Booking own;
    try {
      for (std::uint64_t at; (at = next.fetch_add(kBatch)) < last;)
        for (std::uint64_t i = at; i < std::min(at + kBatch, last); ++i)
          shootOne(std::uint32_t(i), own);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception(), next = last;
    }
    const std::lock_guard lock(mutex);
    booking.add(own);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& t : others) t.join();
  if (failure) std::rethrow_exception(failure);
}

void Shooting::shootOne(std::uint32_t index, Booking& booking) const {
  const Sampler sampler(0x70617274u, 0, index, seed);  // "part": no pixel uses this sequence
  ++booking.particles;
  const auto choice = scene.chooseLight(sampler.number(kLight));
  if (!choice) return;
  const Light& light = *scene.lights()[std::size_t(choice->light)];
  const EmissionNumbers u{sampler.pair(kPoint), sampler.pair(kDirection)};
  const std::optional<Particle> particle = light.emit(u);
  if (!particle) return;

  const Real size = scene.bounds().isEmpty() ? Real(0) : length(scene.bounds().size());
  Rgb power = particle->power / choice->chance;
  const Real rounding = sampler.number(kRounding);
  Flux carried = inUnits(power, rounding);
  add(booking.emitted, carried);
  PathFootprint<> path;
  path.begin(*particle, light.emissionDerivatives(u), index, particles, footprint);
  path.chance(choice->chance);

  Ray ray = start(*particle, size);
  ray.kind = RayKind::indirect;
  ray.media = scene.mediaAt(ray.origin);
  Surface s;
  InputBuffer inputs;
  Interaction x;
  // Books the difference between what the particle carried and its power now.
  const auto absorbed = [&] {
    const Flux left = inUnits(power, rounding);
    add(booking.absorbed, carried);
    add(booking.absorbed, left, -1);
    carried = left;
  };
  std::uint32_t layer = 0;
  for (int bounce = 0;;) {
    const bool isMet = scene.intersect(ray, s);
    if (!ray.media.isEmpty()) {
      power *= scene.mediumTransmittance(ray, isMet ? s.distance : kInfinity);
      absorbed();
      if (isBlack(power)) return add(booking.absorbed, carried);
    }
    if (!isMet) return add(booking.escaped, carried);
    path.arrive(s, size);
    scene.shade(s, -ray.direction, scene.usesFootprint(s) ? path.footprint() : Footprint{}, inputs,
                x);
    const std::uint32_t dim = dimension::vertex(std::uint32_t(bounce));
    // Before opacity: eye paths apply the opacity themselves.
    const PatchPoint at = patchPointOf(s, x.toPrev);
    if (hierarchy.keeps(at)) {
      ++booking.hits;
      hierarchy.deposit(at, areaOf(path, area), inUnits(bending(x) * power, rounding));
    }
    if (!isOpaque(x.opacity)) {
      const Passage passage =
          meetLayer(sampler, std::uint32_t(bounce), layer, index, x.opacity, power);
      path.chance(passage.chance);
      if (!(passage.weight == grey(1))) {
        power *= passage.weight;
        const Flux weighted = inUnits(power, rounding);
        add(booking.gained, weighted);
        add(booking.gained, carried, -1);
        carried = weighted;
      }
      if (!passage.stays) {
        if (++layer == kMaxLayers) return add(booking.absorbed, carried);
        ray = spawnRay(s, ray.direction, ray.kind);
        continue;
      }
    }
    layer = 0;

    const ScatterNumbers random{sampler.number(dim + dimension::kLobe),
                                sampler.pair(dim + dimension::kDirection)};
    const std::optional<Scatter> drawn = drawScatter(x, random, Carries::flux);
    if (!drawn) return add(booking.absorbed, carried);
    power *= drawn->weight;
    absorbed();

    const Real most = bounce < kMortalFrom ? Real(1) : kMaxSurvival;
    const Real survival = std::min(maxComponent(drawn->weight), most);
    if (!(sampler.number(dim + dimension::kRoulette) < survival)) return add(booking.lost, carried);
    power = power / survival;
    const Flux grown = inUnits(power, rounding);
    add(booking.gained, grown), add(booking.gained, carried, -1);
    carried = grown;
    path.scatter(s, x, *drawn, random);
    path.chance(survival);
    ray = spawnRay(s, drawn->toNext, kindOf(drawn->local));
    ++bounce;
  }
}

}  // namespace vestige::particle
