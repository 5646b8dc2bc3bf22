// SPDX-License-Identifier: Apache-2.0
// Expected numbers: sRGB by IEC 61966-2-1; ACES' output transform as OpenColorIO 2.1 alone gives it
// (measured once, outside this code: a change here or in the config shows); matrices as published.
#include "engine/colour/colour.h"

#include <stdlib.h>

#include <array>
#include <cmath>
#include <fstream>

#include "support/catch.h"
#include "support/temp_folder.h"

using namespace vestige;
using vestige::test::TempFolder;

namespace {

using Triple = std::array<float, 3>;

Triple through(const std::shared_ptr<const ColourTransform>& transform, Triple c) {
  REQUIRE(transform);
  transform->apply(c.data(), 1, 3);
  return c;
}

Triple shown(double linear, const Display& display) {
  std::string error;
  return through(forDisplay(display, error), {float(linear), float(linear), float(linear)});
}

void checkNear(const Triple& found, const Triple& expected, double margin = 2e-5) {
  for (std::size_t c = 0; c < 3; ++c) CHECK(found[c] == Approx(expected[c]).margin(margin));
}

/// OCIO names another config while this lives.
class OtherConfig {
 public:
  explicit OtherConfig(const std::string& file) { setenv("OCIO", file.c_str(), 1); }
  ~OtherConfig() { unsetenv("OCIO"); }
};

/// A config whose only display squares what it shows, with or without a way to name its primaries.
void writeConfig(const std::string& file, bool interchange) {
  std::ofstream(file) << "ocio_profile_version: 2\n"
                         "environment: {}\n"
                         "roles: {default: Working, scene_linear: Working"
                      << (interchange ? ", aces_interchange: AP0" : "")
                      << "}\n"
                         "displays:\n"
                         "  Wall:\n"
                         "    - !<View> {name: Squared, colorspace: Squares}\n"
                         "active_displays: []\n"
                         "active_views: []\n"
                         "colorspaces:\n"
                         "  - !<ColorSpace> {name: AP0, encoding: scene-linear}\n"
                         "  - !<ColorSpace>\n"
                         "    name: Working\n"
                         "    to_scene_reference: !<BuiltinTransform> {style: "
                         "ACEScg_to_ACES2065-1}\n"
                         "  - !<ColorSpace>\n"
                         "    name: Squares\n"
                         "    to_scene_reference: !<GroupTransform>\n"
                         "      children:\n"
                         "        - !<ExponentTransform> {value: 0.5}\n"
                         "        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}\n";
}

}  // namespace

TEST_CASE("sRGB's curve", "[colour]") {
  CHECK(decodeSrgb(128 / 255.0) == Approx(0.2158605));
  CHECK(decodeSrgb(10 / 255.0) == Approx(10 / 255.0 / 12.92));
  CHECK(encodeSrgb(0.18) == Approx(0.4613561));
  for (int i = 0; i < 256; ++i) CHECK(encodeSrgb(decodeSrgb(i / 255.0)) == Approx(i / 255.0));
}

TEST_CASE("the default view is sRGB's curve and nothing else", "[colour]") {
  checkNear(shown(0.18, {}), {0.46136f, 0.46136f, 0.46136f});
  checkNear(shown(1, {}), {1, 1, 1});
  checkNear(shown(16, {}), {3.29f, 3.29f, 3.29f}, 5e-3);  // not clamped here
  std::string error;
  // Rec. 709's primaries are the display's: no mixing.
  checkNear(through(forDisplay({}, error), {0.5f, 0.18f, 0.f}), {0.73536f, 0.46136f, 0.f}, 1e-4);
}

TEST_CASE("ACES' view and exposure", "[colour]") {
  const Display aces{0, "ACES 1.0 SDR", ""};
  checkNear(shown(0.18, aces), {0.35595f, 0.35595f, 0.35595f}, 1e-4);
  checkNear(shown(1, aces), {0.81197f, 0.81197f, 0.81197f}, 1e-4);
  checkNear(shown(16, aces), {0.99974f, 0.99974f, 0.99974f}, 1e-4);
  checkNear(shown(0.18, {1, "ACES 1.0 SDR", ""}), {0.550f, 0.550f, 0.550f}, 1e-3);
  checkNear(shown(0.18, {2, "ACES 1.0 SDR", ""}), {0.745f, 0.745f, 0.745f}, 1e-3);
  checkNear(shown(0.3, {1, "Raw", ""}), {0.6f, 0.6f, 0.6f});
}

TEST_CASE("colour spaces are turned into rendering space", "[colour]") {
  std::string error;
  // Red of Rec. 709 in ACEScg's primaries [published matrix, Bradford].
  checkNear(through(fromColourSpace("ACEScg", error), {0.61310f, 0.07019f, 0.02062f}), {1, 0, 0},
            1e-4);
  checkNear(through(fromColourSpace("sRGB - Texture", error), {0.5f, 0.5f, 0.5f}),
            {0.21404f, 0.21404f, 0.21404f});
  const auto raw = fromColourSpace("Raw", error);
  REQUIRE(raw);
  CHECK(raw->isIdentity());
  const auto same = fromColourSpace("lin_rec709", error);
  REQUIRE(same);
  CHECK(same->isIdentity());
}

TEST_CASE("unknown names are answered with those known", "[colour]") {
  std::string error;
  CHECK(!forDisplay({0, "Filmic", ""}, error));
  CHECK_THAT(error, containsText("no view 'Filmic'") && containsText("'ACES 1.0 SDR'"));
  CHECK(!forDisplay({0, "", "Cinema"}, error));
  CHECK_THAT(error, containsText("no display 'Cinema'") && containsText("'sRGB'"));
  CHECK(!fromColourSpace("Rec.2020", error));
  CHECK_THAT(error, containsText("no colour space 'Rec.2020'") && containsText("'ACEScg'"));
}

TEST_CASE("the environment variable OCIO names another config", "[colour]") {
  const TempFolder folder;
  std::string error;
  SECTION("a display of its own") {
    writeConfig(folder / "own.ocio", false);
    const OtherConfig other(folder / "own.ocio");
    checkNear(shown(0.5, {}), {0.25f, 0.25f, 0.25f}, 1e-4);
    CHECK(!forDisplay({0, "Standard", ""}, error));
    CHECK_THAT(error, containsText("'Squared'"));
  }
  SECTION("rendering space is found through the interchange role") {
    writeConfig(folder / "own.ocio", true);
    const OtherConfig other(folder / "own.ocio");
    checkNear(through(forDisplay({}, error), {1, 0, 0}),
              {0.61310f * 0.61310f, 0.07019f * 0.07019f, 0.02062f * 0.02062f}, 1e-4);
    checkNear(through(fromColourSpace("Working", error), {0.61310f, 0.07019f, 0.02062f}), {1, 0, 0},
              1e-4);
  }
  SECTION("one that cannot be read is an error, not ignored") {
    const OtherConfig other(folder / "none.ocio");
    CHECK(!forDisplay({}, error));
    CHECK_THAT(error, containsText("OCIO") && containsText("none.ocio"));
  }
  checkNear(shown(0.18, {}), {0.46136f, 0.46136f, 0.46136f});
}
