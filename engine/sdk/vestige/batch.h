// SPDX-License-Identifier: Apache-2.0
// Many scattering events in one call, one array a component. VESTIGE_PLUGIN writes these loops for
// every BRDF from its scalar methods; the compiler inlines them and vectorises where it can.
// Authors never write batches. The results equal those of the scalar methods to the bit.
#pragma once
#include <vestige/brdf.h>

#include <cstdint>

namespace vestige {

/// Vectors (or colours) as three arrays of n numbers.
struct ConstVectorBatch {
  const Real *x, *y, *z;
  Vec3 get(int i) const noexcept { return {x[i], y[i], z[i]}; }
};
struct VectorBatch {
  Real *x, *y, *z;
  void set(int i, Vec3 v) const noexcept {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

struct ScatterPointBatch {
  ConstVectorBatch toPrev;
  const std::uint8_t* behind;  ///< 0 or 1
  const Real *etaPrev, *etaNext;
  const Inputs* inputs;
  ScatterPoint get(int i) const noexcept {
    return {toPrev.get(i), behind[i] != 0, etaPrev[i], etaNext[i], inputs[i]};
  }
};

struct ScatterValueBatch {
  VectorBatch fCos;  ///< red, green, blue
  Real* pdf;
  void set(int i, const ScatterValue& v) const noexcept {
    fCos.set(i, {v.fCos.r, v.fCos.g, v.fCos.b});
    pdf[i] = v.pdf;
  }
};

struct ScatterNumbersBatch {
  const Real *lobe, *u, *v;
  ScatterNumbers get(int i) const noexcept { return {lobe[i], {u[i], v[i]}}; }
};

/// The result of one draw.
enum class Drawn : std::uint8_t { nothing, direction, specular };

struct ScatterSampleBatch {
  VectorBatch toNext, weight;
  Real *pdf, *lobePdf, *lobeChance;
  std::int32_t* lobe;
  Drawn* drawn;
  /// If nothing was drawn, only `drawn` is defined.
  void set(int i, const std::optional<ScatterSample>& s) const noexcept {
    drawn[i] = !s ? Drawn::nothing : s->specular ? Drawn::specular : Drawn::direction;
    if (!s) return;
    toNext.set(i, s->toNext);
    weight.set(i, {s->weight.r, s->weight.g, s->weight.b});
    pdf[i] = s->pdf;
    lobePdf[i] = s->lobePdf;
    lobeChance[i] = s->lobeChance;
    lobe[i] = s->lobe;
  }
};

/// Brdf's methods for n points at once. The BRDF must be an object of the class that the batch was
/// instantiated for.
struct BrdfBatch {
  void (*evaluate)(const Brdf& brdf, int n, const ScatterPointBatch& points,
                   const ConstVectorBatch& toNext, const ScatterValueBatch& out) noexcept;
  void (*sample)(const Brdf& brdf, int n, const ScatterPointBatch& points,
                 const ScatterNumbersBatch& numbers, const ScatterSampleBatch& out) noexcept;
};

/// The batch of one class: its methods are called directly, not through the virtual table.
template <class Class>
inline constexpr BrdfBatch kBrdfBatch = {
    [](const Brdf& brdf, int n, const ScatterPointBatch& points, const ConstVectorBatch& toNext,
       const ScatterValueBatch& out) noexcept {
      const Class& self = static_cast<const Class&>(brdf);
      for (int i = 0; i < n; ++i) out.set(i, self.Class::evaluate(points.get(i), toNext.get(i)));
    },
    [](const Brdf& brdf, int n, const ScatterPointBatch& points, const ScatterNumbersBatch& numbers,
       const ScatterSampleBatch& out) noexcept {
      const Class& self = static_cast<const Class&>(brdf);
      for (int i = 0; i < n; ++i) out.set(i, self.Class::sample(points.get(i), numbers.get(i)));
    }};

}  // namespace vestige
