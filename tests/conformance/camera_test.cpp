// SPDX-License-Identifier: Apache-2.0
// Cameras: rays worked out by hand, and what the judge asks of each (judge/camera_tests.h).
#include "judge/camera_tests.h"
#include "support/findings.h"
#include "support/judge.h"
#include "support/plugins.h"

namespace vestige::test {
namespace {

Value at(Vec3 p) { return vectorValue({double(p.x), double(p.y), double(p.z)}); }

std::shared_ptr<Camera> camera(const std::string& name, const Settings& settings,
                               const Affine& toWorld = {}) {
  return make<Camera>(pluginNamed("camera", name), settings, toWorld);
}

void checkNear(Vec3 seen, Vec3 expected) {
  INFO("seen " << seen.x << ' ' << seen.y << ' ' << seen.z << ", expected " << expected.x << ' '
               << expected.y << ' ' << expected.z);
  CHECK(length(seen - expected) < Real(1e-5));
}

/// The ray through a film point, at the middle of a lens.
CameraSample through(const Camera& c, Real x, Real y, Real aspect = 1) {
  return *c.sample({{x, y}, {Real(0.5), Real(0.5)}, aspect});
}

Affine turnedAboutY(double degrees, Vec3 offset) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  Affine a;
  a.m[0][0] = c, a.m[0][2] = s, a.m[2][0] = -s, a.m[2][2] = c;
  for (int i = 0; i < 3; ++i) a.m[i][3] = double(offset[i]);
  return a;
}

/// Rows shared by the cameras below: oblique, so that no axis is a special one.
Settings oblique(Settings own = {}) {
  own["location"] = at({1, 2, -4});
  own["look_at"] = at({Real(0.3), Real(0.5), Real(0.2)});
  own["sky"] = at({Real(0.2), 1, Real(0.1)});
  return own;
}

struct Case {
  std::string name;
  Settings settings;
};
std::vector<Case> cases() {
  return {{"pinhole", oblique({{"angle", numberValue(60)}})},
          {"thin_lens", oblique({{"angle", numberValue(50)},
                                 {"aperture", numberValue(0.6)},
                                 {"focal_point", at({0, 0, 1})}})},
          {"orthographic", oblique({{"width", numberValue(3)}})},
          {"panorama", oblique()}};
}

}  // namespace

TEST_CASE("camera pinhole: +x is on the right, +y up", "[camera][pinhole]") {
  const auto c = camera(
      "pinhole",
      {{"location", at({0, 0, -5})}, {"look_at", at({0, 0, 0})}, {"angle", numberValue(90)}});
  checkNear(through(*c, 0.5, 0.5).origin, {0, 0, -5});
  checkNear(through(*c, 0.5, 0.5).direction, {0, 0, 1});
  checkNear(through(*c, 1, 0.5, 2).direction, normalize({1, 0, 1}));
  checkNear(through(*c, 0.5, 0, 2).direction, normalize({0, Real(0.5), 1}));
  checkNear(through(*c, 0, 1, 2).direction, normalize({-1, Real(-0.5), 1}));
  CHECK(isFinite(through(*c, 0, 0).weight - Rgb{1, 1, 1}));
  CHECK(through(*c, 0, 0).weight == Rgb{1, 1, 1});

  SECTION("seen from behind, +x is on the left") {
    const auto back = camera(
        "pinhole",
        {{"location", at({0, 0, 5})}, {"look_at", at({0, 0, 0})}, {"angle", numberValue(90)}});
    checkNear(through(*back, 1, 0.5).direction, normalize({-1, 0, -1}));
    checkNear(through(*back, 0.5, 0).direction, normalize({0, 1, -1}));
  }
  SECTION("sky rolls the camera") {
    const auto rolled = camera("pinhole", {{"location", at({0, 0, -5})},
                                           {"look_at", at({0, 0, 0})},
                                           {"sky", at({1, 0, 0})},
                                           {"angle", numberValue(90)}});
    checkNear(through(*rolled, 0.5, 0).direction, normalize({1, 0, 1}));
    checkNear(through(*rolled, 1, 0.5).direction, normalize({0, -1, 1}));
  }
  SECTION("a sky that is not across the view only says which way is up") {
    const auto slanted = camera("pinhole", {{"location", at({0, 0, -5})},
                                            {"look_at", at({0, 0, 0})},
                                            {"sky", at({0, 3, 2})},
                                            {"angle", numberValue(90)}});
    checkNear(through(*slanted, 0.5, 0).direction, normalize({0, 1, 1}));
  }
}

TEST_CASE("camera orthographic and panorama: known rays", "[camera][orthographic][panorama]") {
  const Settings place = {{"location", at({1, 2, 3})}, {"look_at", at({1, 2, 4})}};
  Settings wide = place;
  wide["width"] = numberValue(4);
  const auto o = camera("orthographic", wide);
  checkNear(through(*o, 1, 0, 2).origin, {3, 3, 3});
  checkNear(through(*o, 0, 0.5, 2).origin, {-1, 2, 3});
  checkNear(through(*o, 1, 0, 2).direction, {0, 0, 1});
  CHECK(o->pdf({}, {0, 0, 1}, 1) == 0);

  const auto p = camera("panorama", place);
  checkNear(through(*p, 0.25, 0.25).origin, {1, 2, 3});
  checkNear(through(*p, 0.5, 0.5).direction, {0, 0, 1});
  checkNear(through(*p, 0.75, 0.5).direction, {1, 0, 0});
  checkNear(through(*p, 0.25, 0.5).direction, {-1, 0, 0});
  checkNear(through(*p, 0, 0.5).direction, {0, 0, -1});
  checkNear(through(*p, 0.3, 0).direction, {0, 1, 0});
  checkNear(through(*p, 0.5, 0.75).direction, normalize({0, -1, 1}));
}

TEST_CASE("camera thin_lens: all rays of a film point meet in the plane of focus",
          "[camera][thin_lens]") {
  const Settings place = {{"location", at({0, 0, -5})},
                          {"look_at", at({0, 0, 0})},
                          {"angle", numberValue(90)},
                          {"aperture", numberValue(0.5)}};
  Settings byPoint = place, byDistance = place;
  byPoint["focal_point"] = at({3, 1, -1});  // distance along the view: 4
  byDistance["focus_distance"] = numberValue(4);
  Settings byLookAt = place;
  byLookAt["look_at"] = at({0, 0, -1});
  for (const Settings& s : {byPoint, byDistance, byLookAt}) {
    const auto c = camera("thin_lens", s);
    CHECK(c->variables() == 4);
    checkNear(through(*c, 1, 0.5).direction, normalize({1, 0, 1}));
    // The rim of the lens, a quarter of a unit to the right, to the point <4, 2, -1>.
    const CameraSample rim = *c->sample({{1, Real(0.25)}, {1, Real(0.5)}, 1});
    checkNear(rim.origin, {Real(0.25), 0, -5});
    checkNear(rim.direction, normalize({Real(3.75), 2, 4}));
  }
  Settings closed = place;
  closed["aperture"] = numberValue(0);
  CHECK(camera("thin_lens", closed)->variables() == 2);
}

TEST_CASE("camera transforms: the camera moves as an object would", "[camera]") {
  const Affine move = turnedAboutY(30, {4, 5, 6});
  Random random(1);
  for (const Case& c : cases()) {
    INFO(c.name);
    const auto still = camera(c.name, c.settings), moved = camera(c.name, c.settings, move);
    Real worst = 0;
    for (int i = 0; i < 100; ++i) {
      const CameraNumbers n = {random.pair(), random.pair(), Real(1.5)};
      const CameraSample a = *still->sample(n), b = *moved->sample(n);
      worst = std::max(worst, length(move.point(a.origin) - b.origin));
      worst = std::max(worst, length(move.vector(a.direction) - b.direction));
    }
    CHECK(worst < Real(1e-5));
  }
  SECTION("a mirror turns the picture over, a scale takes lengths along") {
    Affine mirror;
    mirror.m[0][0] = -1;
    const auto p = camera("pinhole", {{"angle", numberValue(90)}}, mirror);
    checkNear(through(*p, 1, 0.5).direction, normalize({-1, 0, 1}));
    checkNear(through(*p, 0.5, 0).direction, normalize({0, 1, 1}));
    Affine twice;
    for (int i = 0; i < 3; ++i) twice.m[i][i] = 2;
    const auto o = camera("orthographic", {{"width", numberValue(4)}}, twice);
    checkNear(through(*o, 1, 0.5).origin, {4, 0, 0});
    const auto l = camera(
        "thin_lens", {{"aperture", numberValue(1)}, {"focus_distance", numberValue(3)}}, twice);
    const CameraSample rim = *l->sample({{Real(0.5), Real(0.5)}, {1, Real(0.5)}, 1});
    checkNear(rim.origin, {1, 0, 0});
    checkNear(rim.direction, normalize({-1, 0, 6}));
  }
}

TEST_CASE("camera: what the judge asks of all", "[camera]") {
  const judge::Effort effort = {.samples = 1 << 16, .falseAlarm = 1e-3};
  judge::CameraCases judged;
  for (const Case& c : cases()) judged.push_back({c.name, camera(c.name, c.settings)});
  const judge::CameraDensityFindings density = judge::cameraRaysFollowPdf(judged, effort);
  check(density.distribution);
  check(density.mass);
  CHECK(density.distribution.worst.events == 9);  // of an orthographic camera there is no density
  check(judge::cameraAreaIsInverseDensity(judged, effort));
  check(judge::cameraRaysAreDifferentiated(judged, effort));
  check(judge::cameraIsNeverNan(judged, effort));
  check(judge::cameraAnswersStayTheSame(judged, effort));
}

TEST_CASE("camera thin_lens: lens differentials vanish in the plane of focus",
          "[camera][thin_lens][derivatives]") {
  // [MATH 1.2]: what pbrt-v2 once forgot
  const Vec3 normal = normalize(Vec3{0, 0, -1});
  const auto cam = camera("thin_lens", {{"aperture", numberValue(0.8)},
                                        {"angle", numberValue(70)},
                                        {"focus_distance", numberValue(3)}});
  Random random(4);
  Real inFocus = 0, before = kInfinity;
  for (int i = 0; i < 500; ++i) {
    const CameraNumbers n = {random.pair(), random.pair(), 1};
    const CameraSample s = *cam->sample(n);
    const RayJacobian j = cam->sampleDerivatives(n);
    for (int k = 2; k < 4; ++k) {
      const auto on = [&](Real depth) {  // after the transfer to z = depth [MATH 1.3]
        const Vec3 w = j.dOrigin[k] + depth / s.direction.z * j.dDirection[k];
        return length(w - dot(w, normal) / dot(s.direction, normal) * s.direction);
      };
      inFocus = std::max(inFocus, on(3)), before = std::min(before, on(1));
    }
  }
  CHECK(inFocus < (sizeof(Real) == 8 ? 1e-12 : 1e-5));
  CHECK(before > Real(0.1));
}

TEST_CASE("camera parameters that make no sense are refused", "[camera][errors]") {
  const auto refused = [](const std::string& name, Settings settings, const std::string& words) {
    INFO(name << ": " << words);
    CHECK_THROWS_WITH(camera(name, settings), containsText(words));
  };
  for (const char* name : {"pinhole", "thin_lens", "orthographic", "panorama"}) {
    refused(name, {{"location", at({1, 2, 3})}, {"look_at", at({1, 2, 3})}},
            "look_at is <1, 2, 3>, the camera's own location");
    refused(name, {{"look_at", at({0, 5, 0})}}, "lies along the view direction");
    refused(name, {{"sky", at({0, 0, 0})}}, "sky has no direction");
  }
  for (const double angle : {0.0, -10.0, 180.0, 200.0})
    refused("pinhole", {{"angle", numberValue(angle)}}, "less than 180 degrees");
  refused("thin_lens", {{"focal_point", at({0, 0, -1})}}, "lies behind the camera");
  refused("thin_lens", {{"focus_distance", numberValue(-1)}}, "expected more than 0");
  refused("thin_lens", {{"focus_distance", numberValue(1)}, {"focal_point", at({0, 0, 2})}},
          "expected one of them");
  refused("thin_lens", {{"aperture", numberValue(-1)}}, "diameter of the lens");
  refused("orthographic", {{"width", numberValue(0)}}, "width is 0: expected more than 0");
}

}  // namespace vestige::test
