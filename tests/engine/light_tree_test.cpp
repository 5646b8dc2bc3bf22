// SPDX-License-Identifier: Apache-2.0
// Choosing one of many lights: chances are those with which lights are drawn, no light that reaches
// a point is left out, and what matters there is drawn more often.
#include "engine/light/light_tree.h"

#include <memory>

#include "support/catch.h"
#include "support/lights.h"

namespace vestige::test {
namespace {

/// A lamp that shines evenly into a cone; `reach` kPi: everywhere.
class Lamp final : public Light {
 public:
  Lamp(Vec3 location, Real watts, Vec3 axis = {0, 0, 1}, Real reach = kPi)
      : location_(location), axis_(axis), watts_(watts), reach_(reach) {}

  LightTraits traits() const noexcept override {
    return {.isDelta = isWanted,
            .isInfinite = isAtInfinity,
            .isDrawn = isWanted};  // a delta light is always drawn
  }
  std::optional<LightSample> sample(const Receiver&, Vec2) const noexcept override {
    return std::nullopt;
  }
  Real pdf(const Receiver&, const LightHit&) const noexcept override { return 0; }
  Rgb eval(const LightHit&) const noexcept override { return {}; }
  LightExtent extent() const noexcept override {
    if (isAnywhere || isAtInfinity) return {};
    return {{location_, location_}, axis_, 0, reach_};
  }
  Rgb power() const noexcept override { return grey(watts_); }

  /// Across the way to it.
  double irradiance(Vec3 at) const {
    const Vec3 way = at - location_;
    if (isAnywhere || isAtInfinity) return double(watts_);
    if (dot(normalize(way), axis_) < std::cos(reach_)) return 0;
    return double(watts_ / lengthSquared(way));
  }

  bool isAnywhere = false, isAtInfinity = false, isWanted = true;

 private:
  Vec3 location_, axis_;
  Real watts_, reach_;
};

struct Lamps {
  std::vector<std::unique_ptr<Lamp>> owned;
  std::vector<const Light*> list;
  LightTree tree;

  Lamp& add(const Lamp& lamp) {
    owned.push_back(std::make_unique<Lamp>(lamp));
    list.push_back(owned.back().get());
    return *owned.back();
  }
  void build() { tree.build(list); }
  double irradiance(Vec3 at) const {
    double sum = 0;
    for (const auto& l : owned) sum += l->irradiance(at);
    return sum;
  }
};

Vec3 within(Real size, Random& r) { return r.point(-size / 2, size / 2); }

Lamps mixture(int n, std::uint32_t seed) {
  Random r(seed);
  Lamps lamps;
  for (int i = 0; i < n; ++i) {
    const Vec3 axis = normalize(within(1, r));
    const Real reach = i % 3 == 0 ? kPi : Real(0.2) + r.number() * 2;
    const Vec3 location = within(10, r);
    lamps.add({location, 10 * sqr(r.number()), axis, reach});
    if (i % 40 == 7) lamps.owned.back()->isAtInfinity = true;
    if (i % 40 == 27) lamps.owned.back()->isAnywhere = true;
  }
  lamps.build();
  return lamps;
}

}  // namespace

TEST_CASE("lights are chosen with the chances that are told", "[lights]") {
  for (const int n : {1, 2, 3, 17, 200}) {
    const Lamps lamps = mixture(n, std::uint32_t(n));
    Random r(3);
    for (int place = 0; place < 10; ++place) {
      const Vec3 at = within(place < 5 ? 10 : 100, r);
      constexpr int kDraws = 100000;
      std::vector<int> drawn(lamps.list.size());
      int nothing = 0;
      for (int i = 0; i < kDraws; ++i) {
        const auto choice = lamps.tree.choose({at}, (Real(i) + Real(0.5)) / kDraws);
        if (!choice) {
          ++nothing;
          continue;
        }
        ++drawn[std::size_t(choice->light)];
        const Real told = lamps.tree.chance(choice->light, {at});
        if (std::abs(told - choice->chance) > Real(1e-4) * told) {
          FAIL("light " << choice->light << ": chance " << choice->chance << ", told " << told);
        }
      }
      double sum = double(nothing) / kDraws;
      for (std::size_t l = 0; l < drawn.size(); ++l) {
        const auto chance = double(lamps.tree.chance(int(l), {at}));
        INFO(n << " lights, light " << l << " at place " << place);
        CHECK(std::abs(double(drawn[l]) / kDraws - chance) < 3e-5 + 1e-3 * chance);
        if (drawn[l] > 0) sum += chance;
      }
      CHECK(sum == Approx(1).margin(2e-3));
    }
  }
}

TEST_CASE("lights at infinity and finite ones get half of the choices each", "[lights]") {
  // The sky has a million times the power of the lamps, which shine upwards.
  Lamps lamps;
  lamps.add({{}, Real(3e6)}).isAtInfinity = true;
  for (int i = 0; i < 3; ++i) lamps.add({{Real(i), 0, 0}, 1, {0, 1, 0}, Real(0.5)});
  lamps.add({{}, Real(1e6)}).isAtInfinity = true;
  lamps.build();
  const auto chance = [&](int light, Vec3 at) {
    return double(lamps.tree.chance(light, Receiver{at}));
  };
  // By power among themselves, a tenth of it evenly.
  const double above = 0.9 * 0.75 + 0.1 * 0.5;
  const Vec3 lit{1, 50, 0}, dark{1, -50, 0};
  CHECK(chance(0, lit) == Approx(0.5 * above).epsilon(1e-5));
  CHECK(chance(4, lit) == Approx(0.5 * (1 - above)).epsilon(1e-5));
  CHECK(chance(1, lit) + chance(2, lit) + chance(3, lit) == Approx(0.5).epsilon(1e-5));
  // No lamp reaches a point below: all choices go to the sky.
  CHECK(chance(0, dark) == Approx(above).epsilon(1e-5));
  CHECK(chance(4, dark) == Approx(1 - above).epsilon(1e-5));
  for (const int lamp : {1, 2, 3}) CHECK(chance(lamp, dark) == 0);
  const auto last = lamps.tree.choose({dark}, kOneMinusEpsilon);
  REQUIRE(last);
  CHECK(last->light == 4);

  // Without power known on one side, or without lights there, the other gets (nearly) all.
  Lamps black;
  black.add({{}, 0}).isAtInfinity = true;
  black.add({{0, 0, 0}, 1});
  black.build();
  CHECK(double(black.tree.chance(0, Receiver{lit})) == Approx(0.05).epsilon(1e-5));
  CHECK(double(black.tree.chance(1, Receiver{lit})) == Approx(0.95).epsilon(1e-5));
  Lamps unlit;
  unlit.add({{}, 5}).isAtInfinity = true;
  unlit.add({{0, 0, 0}, 0});
  unlit.build();
  CHECK(double(unlit.tree.chance(0, Receiver{lit})) == Approx(0.95).epsilon(1e-5));
}

TEST_CASE("draws have the frequencies that chances say", "[lights]") {
  // Pearson's statistic of random draws; 5 deviations beyond its mean.
  for (const bool hasSky : {false, true}) {
    Lamps lamps;
    Random r(21);
    for (int i = 0; i < 12; ++i)
      lamps.add({within(4, r), Real(0.5) + r.number(), {0, 1, 0}, Real(0.8)});
    for (int i = 0; hasSky && i < 3; ++i) lamps.add({{}, Real(100 * (i + 1))}).isAtInfinity = true;
    lamps.build();
    for (const Vec3 at : {Vec3{0, 20, 0}, Vec3{1, 1, 0}, Vec3{3, -20, 1}, Vec3{0, -60, 0}}) {
      constexpr int kDraws = 50000;
      std::vector<int> drawn(lamps.list.size() + 1);  // the last: none
      for (int i = 0; i < kDraws; ++i) {
        const auto choice = lamps.tree.choose({at}, r.number());
        ++drawn[choice ? std::size_t(choice->light) : lamps.list.size()];
      }
      double sum = 0, statistic = 0;
      int freedoms = -1;
      for (std::size_t l = 0; l < drawn.size(); ++l) {
        const bool isNone = l == lamps.list.size();
        const double chance = isNone ? 1 - sum : double(lamps.tree.chance(int(l), {at}));
        sum += chance;
        if (chance < 1e-6) {
          CHECK(drawn[l] == 0);
          continue;
        }
        ++freedoms;
        statistic += sqr(drawn[l] - kDraws * chance) / (kDraws * chance);
      }
      INFO(hasSky << ' ' << at.y << ": " << statistic << " with " << freedoms);
      CHECK(statistic < freedoms + 5 * std::sqrt(2 * std::max(freedoms, 1)));
      if (hasSky) CHECK(drawn.back() < kDraws / 2);
    }
  }
}

TEST_CASE("a light that wants no rays drawn towards it has no chance", "[lights]") {
  Random r(8);
  for (const int wanted : {0, 1, 5}) {
    Lamps lamps;
    for (int i = 0; i < 7; ++i) lamps.add({within(10, r), 1, {0, 1, 0}, kPi});
    for (int i = wanted; i < 7; ++i) lamps.owned[std::size_t(i)]->isWanted = false;
    lamps.build();
    for (int draw = 0; draw < 100; ++draw) {
      const auto choice = lamps.tree.choose({within(10, r)}, r.number());
      REQUIRE(choice.has_value() == (wanted > 0));
      if (choice) CHECK(choice->light < wanted);
    }
    for (int i = 0; i < 7; ++i) CHECK((lamps.tree.chance(i, {within(10, r)}) > 0) == (i < wanted));
  }
}

TEST_CASE("no light that reaches a point is left out", "[lights]") {
  const Lamps lamps = mixture(300, 5);
  Random r(4);
  for (int place = 0; place < 300; ++place) {
    const Vec3 at = within(12, r);
    for (std::size_t l = 0; l < lamps.owned.size(); ++l)
      if (lamps.owned[l]->irradiance(at) > 0) {
        INFO("light " << l << " at " << at.x << ' ' << at.y << ' ' << at.z);
        REQUIRE(lamps.tree.chance(int(l), {at}) > 0);
      }
  }
}

TEST_CASE("lights do not say that they reach less far than they do", "[lights]") {
  Random r(11);
  for (const LightCase& c : lightCases()) {
    const LightExtent extent = c.light->extent();
    if (extent.box.isEmpty()) continue;
    const LightCluster cluster(extent, 1);
    int reached = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 from = extent.box.centre() + within(i % 2 ? 4 : 40, r);
      const auto drawn = c.light->sample({from}, r.pair());
      if (!drawn || isBlack(drawn->radiance)) continue;
      ++reached;
      if (!(cluster.importance(from) > 0)) {
        FAIL(c.name << " at " << from.x << ' ' << from.y << ' ' << from.z);
      }
    }
    INFO(c.name);
    CHECK(reached > 0);
  }
}

TEST_CASE("lights that matter are chosen more often", "[lights]") {
  Random r(6);
  Lamps lamps;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 location = within(10, r);
    lamps.add({location, 10 * sqr(r.number())});
  }
  lamps.build();
  LightTable byPower;
  std::vector<double> powers;
  for (const Light* l : lamps.list) powers.push_back(double(l->power().r));
  byPower.build(powers);
  double better = 0;
  for (int place = 0; place < 20; ++place) {
    const Vec3 at = within(10, r);
    const double truth = lamps.irradiance(at);
    constexpr int kDraws = 20000;
    double sum = 0, squares = 0, tableSquares = 0;
    for (int i = 0; i < kDraws; ++i) {
      const auto choice = lamps.tree.choose({at}, r.number());
      const double x =
          choice ? lamps.owned[std::size_t(choice->light)]->irradiance(at) / double(choice->chance)
                 : 0;
      sum += x, squares += x * x;
      const LightChoice other = byPower.choose(r.number());
      const double y = lamps.owned[std::size_t(other.light)]->irradiance(at) / double(other.chance);
      tableSquares += y * y;
    }
    const double mean = sum / kDraws, variance = squares / kDraws - mean * mean;
    INFO("place " << place << ": " << mean << ", truth " << truth);
    CHECK(std::abs(mean - truth) < 5 * std::sqrt(variance / kDraws));
    better += std::log((tableSquares / kDraws - truth * truth) / variance) / 20;
  }
  INFO("variance by power is " << std::exp(better) << " times that of the tree");
  CHECK(better > std::log(10));
}

TEST_CASE("a tree of lights that are hard to tell apart", "[lights]") {
  Lamps none;
  none.build();
  CHECK(!none.tree.choose({1, 2, 3}, Real(0.5)));

  Lamps heap;  // all in one place, half of them dark or with a power that is no number
  for (int i = 0; i < 1000; ++i)
    heap.add({{1, 1, 1}, i % 4 == 0 ? Real(0) : i % 4 == 1 ? Real(NAN) : Real(2)});
  heap.build();
  for (const Vec3 at : {Vec3{1, 1, 1}, Vec3{5, 0, 0}, Vec3{1e6, 0, 0}}) {
    double sum = 0;
    for (int l = 0; l < 1000; ++l) sum += double(heap.tree.chance(l, {at}));
    CHECK(sum == Approx(1).margin(1e-3));
    CHECK(heap.tree.choose({at}, Real(0.3)));
    for (const int unknown : {0, 1}) CHECK(heap.tree.chance(unknown, {at}) > Real(0.05 / 1000));
  }

  Lamps away;  // shines the other way: nothing is drawn, and nothing is lost
  away.add({{0, 0, 0}, 1, {0, 0, 1}, Real(0.5)});
  away.add({{0, 1, 0}, 1, {0, 0, 1}, Real(0.5)});
  away.build();
  CHECK(!away.tree.choose({0, 0, -5}, Real(0.5)));
  CHECK(away.tree.choose({0, 0, 5}, Real(0.5)));
}

TEST_CASE("a hundred thousand lights", "[lights]") {
  const Lamps lamps = mixture(100000, 2);
  Random r(8);
  int chosen = 0;
  for (int place = 0; place < 100; ++place) {
    const Vec3 at = within(10, r);
    const auto choice = lamps.tree.choose({at}, r.number());
    if (!choice) continue;
    ++chosen;
    CHECK(lamps.tree.chance(choice->light, {at}) == Approx(choice->chance).epsilon(1e-3));
  }
  CHECK(chosen > 50);
}

}  // namespace vestige::test
