// SPDX-License-Identifier: Apache-2.0
// `vestige plugin test`: exit codes, sentences, reports.
#include <fstream>
#include <iterator>

#include "run.h"
#include "support/catch.h"

namespace {

const std::string kPlugins = VESTIGE_PLUGINS, kForeign = VESTIGE_HALF_PDF;

}  // namespace

TEST_CASE("plugin test: a good library", "[app][plugin]") {
  for (const char* name : {"/brdf_phong.so", "/light_spot.so", "/camera_pinhole.so"}) {
    const Run r =
        runVestige({"plugin", "test", kPlugins + name, "--samples", "4096", "--seed", "3"});
    INFO(r.out << r.err);
    CHECK(r.exit == 0);
    CHECK_THAT(r.out, containsText("seed 3"));
    CHECK_THAT(r.out, containsText("pass  "));
  }
  const Run pigment = runVestige({"plugin", "test", kPlugins + "/pigment_agate.so"});
  CHECK(pigment.exit == 0);
  CHECK_THAT(pigment.out, containsText("only its schema and its creation were checked"));
}

TEST_CASE("plugin test: a wrong density is named, with a report", "[app][plugin]") {
  const Folder folder;
  const Run r = runVestige({"plugin", "test", kForeign + "/brdf_half_pdf.so", "--samples", "4096",
                            "--report", folder / "report"});
  INFO(r.out << r.err);
  CHECK(r.exit == 1);
  CHECK_THAT(r.out, containsText("evaluate().pdf is wrong: with {"));
  CHECK_THAT(r.out, containsText("sample() lands 2 times as often as evaluate().pdf predicts"));
  CHECK_THAT(r.out, containsText("toPrev <"));
  // It has no derivatives of its own, so nobody blames it for them.
  CHECK_THAT(r.out, !containsText("lobePdf is wrong"));
  CHECK_THAT(r.out, containsText("leaves derivatives to the engine's finite differences"));
  CHECK(looksLikePicture(folder / "report/density.png"));
  CHECK(looksLikePicture(folder / "report/derivative.png"));
  std::ifstream file(folder / "report/report.txt");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK(text == r.out);
}

TEST_CASE("plugin test: reports of a light and a camera", "[app][plugin]") {
  const Folder folder;
  const auto report = [&](const char* name) {
    const Run r = runVestige(
        {"plugin", "test", kPlugins + name, "--samples", "1024", "--report", folder / "report"});
    INFO(r.err);
    CHECK(r.exit == 0);
    CHECK_THAT(r.out, containsText("nanoseconds a call:  sample() "));
    return r.out;
  };
  const std::string sky = report("/light_environment.so");
  for (const char* name : {"density", "derivative", "flux", "emission"}) {
    const std::string file = std::string(name) + ".png";
    CHECK(looksLikePicture(folder / "report" + ("/" + file)));
    CHECK_THAT(sky, containsText(file + ": "));
  }
  CHECK_THAT(sky, containsText("left at their defaults, of environment: color_space (text)"));
  const std::string lens = report("/camera_thin_lens.so");
  CHECK_THAT(lens, containsText("\ndensity.png: camera thin_lens { aperture "));
  CHECK_THAT(lens, containsText("aspect 4:3"));
}

TEST_CASE("plugin test: what cannot be loaded", "[app][plugin]") {
  const Run missing = runVestige({"plugin", "test", "nowhere.so"});
  CHECK(missing.exit == 3);
  CHECK_THAT(missing.err, containsText("there is no library 'nowhere.so'"));
  const Folder folder;
  const Run text = runVestige({"plugin", "test", folder.write("text.so", "no library")});
  CHECK(text.exit == 3);
  CHECK_THAT(text.err, containsText("was not loaded"));
}
