// SPDX-License-Identifier: Apache-2.0
// A BRDF's batch gives what its scalar methods give, to the bit.
#include <vestige/batch.h>

#include "judge/brdf_tests.h"
#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;
using judge::BrdfCase;

namespace {

constexpr int kPoints = 37;  // no multiple of a vector's width

struct Columns {
  Real v[13][kPoints];
  std::uint8_t behind[kPoints];
  Inputs inputs[kPoints];
};

ScatterPointBatch points(const Columns& c) {
  return {{c.v[0], c.v[1], c.v[2]}, c.behind, c.v[3], c.v[4], c.inputs};
}

/// Points, directions and numbers of one case.
Columns columnsOf(const BrdfCase& c, judge::Random& r) {
  Columns k;
  for (int i = 0; i < kPoints; ++i) {
    const ScatterPoint p = c.at(judge::aboveSurface(r), r.number() < Real(0.5));
    const Vec3 next = judge::anywhere(r);
    const ScatterNumbers n = judge::numbers(r);
    const Real all[] = {p.toPrev.x, p.toPrev.y, p.toPrev.z, p.etaPrev, p.etaNext, next.x,
                        next.y,     next.z,     n.lobe,     n.u.x,     n.u.y};
    for (int j = 0; j < 11; ++j) k.v[j][i] = all[j];
    k.behind[i] = p.behind;
    k.inputs[i] = p.inputs;
  }
  return k;
}

bool same(Vec3 a, Rgb b) { return a.x == b.r && a.y == b.g && a.z == b.b; }

void checkEvaluate(const BrdfCase& c, const BrdfBatch& batch, const Columns& k) {
  Real out[4][kPoints];
  const ConstVectorBatch toNext = {k.v[5], k.v[6], k.v[7]};
  batch.evaluate(*c.brdf, kPoints, points(k), toNext, {{out[0], out[1], out[2]}, out[3]});
  for (int i = 0; i < kPoints; ++i) {
    const ScatterValue v = c.brdf->evaluate(points(k).get(i), toNext.get(i));
    INFO(c.title() << " point " << i);
    CHECK((same({out[0][i], out[1][i], out[2][i]}, v.fCos) && out[3][i] == v.pdf));
  }
}

void checkSample(const BrdfCase& c, const BrdfBatch& batch, const Columns& k) {
  Real out[9][kPoints];
  std::int32_t lobe[kPoints];
  Drawn drawn[kPoints];
  const ScatterNumbersBatch numbers = {k.v[8], k.v[9], k.v[10]};
  batch.sample(
      *c.brdf, kPoints, points(k), numbers,
      {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}, out[6], out[7], out[8], lobe, drawn});
  for (int i = 0; i < kPoints; ++i) {
    const auto s = c.brdf->sample(points(k).get(i), numbers.get(i));
    INFO(c.title() << " point " << i);
    const Drawn expected = !s ? Drawn::nothing : s->specular ? Drawn::specular : Drawn::direction;
    REQUIRE(drawn[i] == expected);
    if (!s) continue;
    const Vec3 d = s->toNext;
    CHECK((out[0][i] == d.x && out[1][i] == d.y && out[2][i] == d.z));
    CHECK(same({out[3][i], out[4][i], out[5][i]}, s->weight));
    CHECK((out[6][i] == s->pdf && out[7][i] == s->lobePdf && out[8][i] == s->lobeChance));
    CHECK(lobe[i] == s->lobe);
  }
}

}  // namespace

TEST_CASE("a batch gives what its scalar methods give", "[brdf][batch]") {
  judge::Random r(17);
  for (const BrdfCase& c : brdfCases(2)) {
    const auto* batch = static_cast<const BrdfBatch*>(pluginNamed("brdf", c.plugin).entry->batch);
    REQUIRE(batch);
    const Columns k = columnsOf(c, r);
    checkEvaluate(c, *batch, k);
    checkSample(c, *batch, k);
  }
}
