// SPDX-License-Identifier: Apache-2.0
// How near particles come to converged paths, beside the other rules of refinement, particle for
// particle: the figures of docs/particles.md.
#include <cmath>
#include <functional>
#include <map>

#include "images/picture.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Luminance of a picture's pixels, and where they lie.
struct View {
  int width = 0;
  std::vector<double> light;
  std::vector<std::array<double, 3>> at;
};

View viewOf(const Image& image) {
  View v;
  v.width = image.width;
  int position = -1;
  for (std::size_t i = 0; i < image.channels.size(); ++i)
    if (image.channels[i] == "position.X") position = int(i);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.at(x, y);
      v.light.push_back(0.2126 * double(p[0]) + 0.7152 * double(p[1]) + 0.0722 * double(p[2]));
      if (position >= 0)
        v.at.push_back({double(p[position]), double(p[position + 1]), double(p[position + 2])});
    }
  return v;
}

/// Two halves of a reference, whose noise drops out of (picture - a)(picture - b).
struct Reference {
  View a, b;

  Reference(const std::filesystem::path& scene, const std::string& arguments, int samples)
      : a(half(scene, arguments, samples, 1)), b(half(scene, arguments, samples, 2)) {}

  using Region = std::function<bool(double x, double y, double z)>;
  /// Relative to the reference's mean there.
  double error(const View& v, const Region& region) const {
    double sum = 0, mean = 0, n = 0;
    for (std::size_t i = 0; i < v.light.size(); ++i) {
      if (!region(a.at[i][0], a.at[i][1], a.at[i][2])) continue;
      sum += (v.light[i] - a.light[i]) * (v.light[i] - b.light[i]);
      mean += (a.light[i] + b.light[i]) / 2, ++n;
    }
    REQUIRE(n > 0);
    return std::sqrt(std::max(sum, 0.0) / n) / (mean / n);
  }
  /// Mean of a picture over the reference's, where a tenth of the region's light is brightest.
  double peak(const View& v, const Region& region) const {
    std::vector<std::size_t> pixels;
    double total = 0;
    const auto truth = [&](std::size_t i) { return (a.light[i] + b.light[i]) / 2; };
    for (std::size_t i = 0; i < v.light.size(); ++i)
      if (region(a.at[i][0], a.at[i][1], a.at[i][2])) pixels.push_back(i), total += truth(i);
    std::sort(pixels.begin(), pixels.end(),
              [&](std::size_t i, std::size_t j) { return truth(i) > truth(j); });
    double seen = 0, wanted = 0;
    for (const std::size_t i : pixels) {
      if (wanted > total / 10) break;
      seen += v.light[i], wanted += truth(i);
    }
    return seen / wanted;
  }

 private:
  static View half(const std::filesystem::path& scene, const std::string& arguments, int samples,
                   int seed) {
    return viewOf(renderFile(scene, arguments + " --integrator path --aov position --spp " +
                                        std::to_string(samples) + " --seed " +
                                        std::to_string(seed)));
  }
};

bool near(double a, double b) { return std::abs(a - b) < 2e-3; }
double away(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

/// The diffuse surfaces of figure 4's room.
const std::map<std::string, Reference::Region> kRegions = {
    {"ceiling", [](double, double y, double) { return near(y, 4); }},
    {"floor", [](double, double y, double) { return near(y, 0); }},
    {"back wall", [](double, double, double z) { return near(z, 3); }},
    {"side walls", [](double x, double, double) { return near(std::abs(x), 3); }},
    {"table", [](double, double y, double) { return near(y, 1.05); }},
    {"ball", [](double x, double y, double z) {
       return std::abs(away(x + 0.85, y - 1.5, z - 0.1) - 0.45) < 5e-3;
     }}};
bool isMatt(double x, double y, double z) {
  for (const auto& [name, region] : kRegions)
    if (region(x, y, z)) return true;
  return false;
}
bool isCaustic(double x, double y, double z) {
  return near(y, 1.05) && away(x - 0.55, 0, z + 0.2) < 0.5;
}

const std::filesystem::path kRoom = source("examples/paper/fig4.scene");
const std::string kSmall = "--width 160 -D Ground=1 ";
constexpr int kSeeds = 3;

/// Root of the mean square over seeds.
double meanError(const std::filesystem::path& scene, const std::string& arguments,
                 const Reference& truth, const Reference::Region& region) {
  double sum = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const View v =
        viewOf(renderFile(scene, arguments + " --spp 16 --seed " + std::to_string(seed)));
    sum += std::pow(truth.error(v, region), 2) / kSeeds;
  }
  return std::sqrt(sum);
}

std::string uniform(int level) {
  return "-D 'Oracle=\"uniform\"' -D Level=" + std::to_string(level);
}

}  // namespace

TEST_CASE("figure 4's room: footprints beside variance and uniform elements", "[images][slow]") {
  const Reference truth(kRoom, kSmall, 4096);
  double best = 1e9;
  for (int level = 4; level <= 8; ++level) {
    const double e = meanError(kRoom, kSmall + uniform(level), truth, isMatt);
    std::printf("figure 4;uniform %d;%.4f\n", level, e);
    best = std::min(best, e);
  }
  const double own = meanError(kRoom, kSmall, truth, isMatt);
  const double pure = meanError(kRoom, kSmall + "-D Edges=0", truth, isMatt);
  std::printf("figure 4;footprint %.4f, over best uniform %.3f;without edges %.4f\n", own,
              own / best, pure);
  CHECK(own / best <= 0.85);  // 0.80 measured
  for (const auto& [name, region] : kRegions) {
    const double here = meanError(kRoom, kSmall, truth, region);
    const double other = meanError(kRoom, kSmall + "-D 'Oracle=\"variance\"'", truth, region);
    std::printf("figure 4;%s;footprint %.4f;variance %.4f\n", name.c_str(), here, other);
    INFO(name);
    CHECK(here <= 1.05 * other);
  }

  // The caustic, by footprints alone: with the gradient's limit it is there, without it blurs.
  const auto peak = [&](const std::string& how) {
    return truth.peak(viewOf(renderFile(kRoom, kSmall + "--spp 16 " + how)), isCaustic);
  };
  const double limited = peak("-D Edges=0"), free = peak("-D Edges=0 -D Limit=0"), all = peak("");
  std::printf("figure 4;caustic's peak of the reference: limited %.3f, not %.3f, with edges %.3f\n",
              limited, free, all);
  CHECK(limited >= 0.8);
  CHECK(all >= 0.8);
  CHECK(free < limited - 0.1);

  // Convergence.
  std::vector<double> errors;
  for (const int n : {10000, 100000, 1000000, 10000000}) {
    const std::string how = kSmall + "--spp 64 -D Particles=" + std::to_string(n);
    errors.push_back(truth.error(viewOf(renderFile(kRoom, how)), isMatt));
    std::printf("figure 4;particles %d;%.4f\n", n, errors.back());
  }
  const double slope = std::log(errors.back() / errors.front()) / std::log(1000.);
  std::printf("figure 4;slope %.3f\n", slope);
  CHECK(slope <= -0.19);
  CHECK(slope >= -0.5);
}

TEST_CASE("where all is of one scale, footprints lose nothing against uniform elements",
          "[images][slow]") {
  std::string text =
      "#ifndef (Oracle) #declare Oracle = \"footprint\"; #end\n"
      "#ifndef (Level) #declare Level = 4; #end\n"
      "camera pinhole { location <1, 1, 0.05> look_at <1, 1, 2> angle 80 }\n"
      "film { resolution <96, 96> filter \"box\" }\n"
      "integrator particle { particles 400000 oracle Oracle level Level }\n"
      "light area { <0.3, 1.999, 0.3>, <1.4, 0, 0>, <0, 0, 1.4> radiance rgb 3 }\n";
  for (const char* quad : {"<0, 0, 0>, <0, 0, 2>, <2, 0, 0>", "<0, 2, 0>, <2, 0, 0>, <0, 0, 2>",
                           "<0, 0, 0>, <0, 2, 0>, <0, 0, 2>", "<2, 0, 0>, <0, 0, 2>, <0, 2, 0>",
                           "<0, 0, 0>, <2, 0, 0>, <0, 2, 0>", "<0, 0, 2>, <0, 2, 0>, <2, 0, 0>"})
    text += std::string("quad { ") + quad + " brdf lambert { diffuse rgb 0.5 } }\n";
  const std::filesystem::path scene = scratch() / "plain.scene";
  std::ofstream(scene) << text;
  const Reference truth(scene, "", 4096);
  const auto isWall = [](double, double y, double) { return y < 1.99; };
  double best = 1e9;
  for (int level = 1; level <= 6; ++level) {
    const double e = meanError(scene, uniform(level), truth, isWall);
    std::printf("one scale;uniform %d;%.4f\n", level, e);
    best = std::min(best, e);
  }
  const double own = meanError(scene, "", truth, isWall);
  std::printf("one scale;footprint %.4f, over best uniform %.3f\n", own, own / best);
  CHECK(own / best <= 1.1);
}

TEST_CASE("a point light through glass converges", "[images][slow]") {
  // Paths from the eye never find it: the truth is that of many particles on fine uniform elements.
  const std::string text =
      "#ifndef (Oracle) #declare Oracle = \"footprint\"; #end\n"
      "#ifndef (Level) #declare Level = 7; #end\n"
      "#ifndef (Particles) #declare Particles = 100000; #end\n"
      "camera orthographic { location <0, 0.05, 0> look_at <0, 0, 0> sky z width 1.6 }\n"
      "film { resolution <96, 96> filter \"box\" }\n"
      "integrator particle { particles Particles oracle Oracle level Level }\n"
      "light point { <0.3, 3, 0> intensity rgb 10 }\n"
      "quad { <-1, 0, -1>, <0, 0, 2>, <2, 0, 0> brdf lambert { diffuse rgb 0.5 } }\n"
      "sphere { <0, 1, 0>, 0.5 brdf rough_dielectric { alpha 0.1 ior 1.5 } }\n";
  const View truth =
      viewOf(renderText(text, "--spp 16 -D Particles=64000000 " + uniform(7) + " --seed 9"));
  std::vector<double> errors;
  for (const int n : {10000, 100000, 1000000, 10000000}) {
    const View v = viewOf(renderText(text, "--spp 16 -D Particles=" + std::to_string(n)));
    double sum = 0, mean = 0;
    for (std::size_t i = 0; i < v.light.size(); ++i)
      sum += std::pow(v.light[i] - truth.light[i], 2), mean += truth.light[i];
    const double pixels = double(v.light.size());
    errors.push_back(std::sqrt(sum / pixels) / (mean / pixels));
    std::printf("point light;particles %d;%.4f\n", n, errors.back());
  }
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i] < 0.8 * errors[i - 1]);
}
