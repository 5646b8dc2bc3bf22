// SPDX-License-Identifier: Apache-2.0
// An integrator with AOVs and a note of its own; `declare` makes the list of AOVs wrong in one
// respect, and the engine must refuse the scene.
#include <vestige/integrator.h>
#include <vestige/plugin.h>

#include <limits>

namespace vestige {
namespace {

class OwnAovs final : public Integrator {
 public:
  enum Row { kValue, kDeclare };
  enum Slot { kConstant, kAim };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "own_aovs",
            .summary = "a grey picture, a constant and where each ray starts",
            .params = {real("value", 1).doc("of AOV test.value"),
                       choice("declare", {"two", "nine", "taken", "all", "twice", "comma",
                                          "no_name", "zero_step", "infinite_step"})
                           .doc("what is wrong with the list of AOVs; two: nothing")}};
  }
  explicit OwnAovs(const Values& values) : value_(values.real(kValue)) {
    const std::string& wrong = values.text(kDeclare);
    slots_ = {{"test.value", "the parameter"},
              {"aim.x", "where the ray starts, scene units", AovMeasure::length, 0x1p-30}};
    static const char* const kNine[] = {"c", "d", "e", "f", "g", "h", "i"};
    if (wrong == "nine")
      for (const char* name : kNine) slots_.push_back({name, ""});
    if (wrong == "taken") slots_[1].name = "depth";
    if (wrong == "all") slots_[1].name = "all";
    if (wrong == "twice") slots_[1].name = "test.value";
    if (wrong == "comma") slots_[1].name = "a,b";
    if (wrong == "no_name") slots_[1].name = nullptr;
    if (wrong == "zero_step") slots_[1].step = 0;
    if (wrong == "infinite_step") slots_[1].step = std::numeric_limits<double>::infinity();
  }

  std::span<const AovSlot> aovs() const noexcept override { return slots_; }

  Rgb estimate(PathContext& c) const noexcept override {
    ++c.counters.rays;
    if (c.aovs) {
      c.aovs->own[kConstant] = value_;
      c.aovs->own[kAim] = c.ray.origin.x;
    }
    if (c.record) {
      c.record->note({"test.start",
                      "scene units",
                      {double(c.ray.origin.x), double(c.ray.origin.y), double(c.ray.origin.z)},
                      3});
      c.record->note({"number", "", {16777215}});
      PathVertex end;
      end.toPrev = -c.ray.direction;
      end.throughput = {1, 1, 1};
      end.event = "escape";
      c.record->add(end);
    }
    return {Real(0.5), Real(0.5), Real(0.5)};
  }

 private:
  Real value_;
  std::vector<AovSlot> slots_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::OwnAovs)
