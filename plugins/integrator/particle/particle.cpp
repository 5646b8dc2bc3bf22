// SPDX-License-Identifier: Apache-2.0
// Hierarchical radiosity by particles, with their footprints as refinement oracle: light is kept on
// diffuse surfaces before the picture, and seen there; what is glossy or specular is found by rays
// from the eye.
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001. Sec. 4.2, Fig. 4
#include <vestige/footprint/language.h>
#include <vestige/plugin.h>

#include <chrono>
#include <memory>

#include "solution_file.h"
#include "viewing.h"

namespace vestige::particle {
namespace {

/// Of `--time`, for particles; the rest is the picture's.
constexpr double kShareOfTime = 0.5;
/// Side of the smallest element, in diameters of the scene, unless the scene says.
constexpr Real kSmallest = Real(2e-4);

/// N_eff^-1/M, at least 1/3, and the limit without which caustics nearly vanish [PD01 4.2].
FootprintSettings particleDefaults() {
  FootprintSettings s;
  s.deltas.bound = Bound::global, s.deltas.limit = kDefaultLimit;
  return s;
}

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma > at) all.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return all;
}

class ParticleIntegrator final : public Integrator {
 public:
  enum Param {
    kParticles,
    kPart,
    kParts,
    kSamples,
    kDepth,
    kOracle,
    kLevel,
    kArea,
    kEdges,
    kClusters,
    kMinArea,
    kMaxLevel,
    kMemory,
    kShow,
    kGlossy,
    kWires,
    kFootprint,
    kSave,
    kLoad
  };

  static Schema schema() {
    return {
        .kind = "integrator",
        .name = "particle",
        .summary =
            "hierarchical radiosity by particles; footprints decide how fine (Suykens and "
            "Willems, 4.2)",
        .params = {
            integer("particles", 400000).range(1, 4'000'000'000).doc("from all lights together"),
            integer("part", 1).range(1, 4096).doc("which of the `parts` of the particles to send"),
            integer("parts", 1)
                .range(1, 4096)
                .doc("add their solutions with --load-solution; with `edges off`, or oracle "
                     "uniform, the sum is that of one run to the bit"),
            integer("samples", 16).range(1, 1 << 24).doc("eye paths a pixel"),
            integer("depth", 16).range(1, 4096).doc("longest eye path in edges"),
            choice("oracle", {"footprint", "variance", "uniform"})
                .doc("what decides how fine elements are: the particle's footprint; where hits "
                     "vary; or everywhere `level`"),
            integer("level", 5).range(0, 14).doc("divisions of every patch, with oracle uniform"),
            choice("area", {"covariance", "polygon"})
                .unset()
                .doc("of a footprint: of its ellipse, or exactly of the polygon (with footprint "
                     "paper)"),
            boolean("edges", true)
                .doc("with oracle footprint: elements are divided further where hits vary in them, "
                     "as at a shadow's edge, which no derivative sees"),
            boolean("clusters", true).doc("wide footprints may land on several patches at once"),
            real("min_area", 0)
                .unset()
                .range(0, 1e12)
                .in("scene units^2")
                .doc("of the smallest element (a square of 1/5000 of the scene's diameter)"),
            integer("max_level", 12).range(0, 16).doc("most divisions of a patch"),
            integer("memory", 1024)
                .range(1, 200'000)
                .in("MiB")
                .doc("for elements; once it is used up they are divided no more"),
            choice("show", {"smooth", "elements", "gather"})
                .doc("irradiance blended between vertices; constant on each element; or light "
                     "gathered by rays from what the eye sees"),
            boolean("glossy", true)
                .doc("whether rays find what is glossy or specular; if not, that part is black, as "
                     "in "
                     "the paper's figure"),
            boolean("wires", false).doc("draws the elements' edges"),
            block("footprint", "footprint").doc("of particles (global, with limit 0.7)"),
            text("save_solution", "").doc("by --save-solution: keeps the light on the surfaces"),
            text("load_solution", "").doc("by --load-solution: files whose sum is seen")}};
  }

  explicit ParticleIntegrator(const Values& v)
      : particles_(std::uint64_t(v.integer(kParticles))),
        part_(std::uint64_t(v.integer(kPart))),
        parts_(std::uint64_t(v.integer(kParts))),
        samples_(int(v.integer(kSamples))),
        footprint_(footprintSettings(v.block(kFootprint), Bound::global, particleDefaults())),
        save_(v.text(kSave)),
        load_(splitAtCommas(v.text(kLoad))) {
    if (part_ > parts_) throw PluginError(kPart, "part is one of 1 to parts");
    if (parts_ > particles_) throw PluginError(kParts, "there are more parts than particles");
    // A scene from elsewhere must not write or read files by itself.
    for (const int row : {int(kSave), int(kLoad)})
      if (v.has(row) && v.span(row).file >= 0)
        throw PluginError(row,
                          "solutions are named on the command line: --save-solution FILE, "
                          "--load-solution FILE");
    const std::string& show = v.text(kShow);
    view_.show = show == "gather"     ? Show::gather
                 : show == "elements" ? Show::elements
                                      : Show::smooth;
    view_.glossy = v.flag(kGlossy), view_.wires = v.flag(kWires);
    view_.depth = int(v.integer(kDepth));
    footprint_.deltas.fewest = 3;
    const bool isPaper = footprint_.shape == RegionShape::representative;
    area_ = (v.has(kArea) ? v.text(kArea) == "polygon" : isPaper) ? FootprintArea::polygon
                                                                  : FootprintArea::covariance;
    const std::string& oracle = v.text(kOracle);
    elements_.oracle = oracle == "variance"  ? Oracle::variance
                       : oracle == "uniform" ? Oracle::uniform
                                             : Oracle::footprint;
    elements_.edges = v.flag(kEdges), elements_.clusters = v.flag(kClusters);
    elements_.maxLevel = int(v.integer(elements_.oracle == Oracle::uniform ? kLevel : kMaxLevel));
    elements_.minArea = v.has(kMinArea) ? v.real(kMinArea) : Real(-1);
    elements_.memory = std::size_t(v.integer(kMemory)) << 20;
  }

  int samples() const noexcept override { return samples_; }

  bool usesJacobian() const noexcept override { return view_.wires; }

  std::span<const AovSlot> aovs() const noexcept override {
    static constexpr AovSlot kSlots[] = {
        {"element.level",
         "divisions of the element seen below its patch; -1: a cluster of patches"},
        {"element.id", "a whole number that tells the element from its neighbours"}};
    return kSlots;
  }

  bool prepare(const Preparation& p) override {
    if (const int silent = silentLights(p.scene); silent > 0)
      p.warn(std::to_string(silent) +
             " of the lights send no particles, as their plugins have no " +
             "emit(): integrator particle leaves them out");
    if (!save_.empty()) checkSolutionFile(save_);
    HierarchySettings settings = elements_;
    const Bounds b = p.scene.bounds();
    if (settings.minArea < 0)
      settings.minArea = b.isEmpty() ? Real(0) : sqr(kSmallest * length(b.size()));
    view_.light = {};
    hierarchy_ = std::make_unique<Hierarchy>(p.scene, settings);
    if (load_.empty() && parts_ > 1 && isDividedByHits())
      p.warn(
          "each part divides its elements by its own hits, so the sum of the parts is not the same "
          "to the bit as one run, and a little coarser: `edges off` with oracle footprint, or "
          "oracle uniform, makes it the same");
    Booking booking;
    SolutionKey key{fingerprint(p.scene, *hierarchy_), 0, 0};
    for (const std::string& file : load_) addSolution(file, key, booking, *hierarchy_);
    bool goesOn = true;
    if (load_.empty()) {
      key.particles = particles_, key.power = totalPower(p.scene);
      if (key.power > 0) goesOn = send(p, key.power, booking);
    }
    if (!save_.empty()) {
      saveSolution(save_, key, booking, *hierarchy_);
      if (!goesOn) p.warn("saved the solution of the particles sent so far as '" + save_ + "'");
    }
    if (!goesOn) return false;
    if (booking.particles > 0)
      view_.light =
          Irradiance(p.scene, *hierarchy_, key.power * kFluxUnit / double(booking.particles));
    return true;
  }

  Rgb estimate(PathContext& context) const noexcept override { return view_.radiance(context); }

 private:
  /// Lights that shine, but never start a particle.
  static int silentLights(const SceneView& scene) {
    int count = 0;
    for (const Light* light : scene.lights()) {
      bool isSilent = luminance(light->power()) > 0;
      for (std::uint32_t i = 0; i < 64 && isSilent; ++i) {
        const Sampler numbers(0, 0, i, 0);
        isSilent = !light->emit({numbers.pair(0), numbers.pair(2)});
      }
      count += isSilent;
    }
    return count;
  }

  /// Whether elements depend on which particles went before: Hierarchy::pause() divides them.
  bool isDividedByHits() const noexcept {
    return elements_.oracle == Oracle::variance ||
           (elements_.oracle == Oracle::footprint && elements_.edges);
  }

  /// False if the user stopped it.
  bool send(const Preparation& p, double power, Booking& booking) {
    const Shooting shooting{p.scene, *hierarchy_, footprint_, area_, particles_, p.seed, power};
    const std::uint64_t first = particles_ * (part_ - 1) / parts_,
                        last = particles_ * part_ / parts_;
    const double start = now();
    for (std::uint64_t at = first, next; at < last; at = next) {
      next = std::min(at + passAfter(at - first), last);
      shooting.pass(at, next, p.threads, booking);
      if (hierarchy_->pause())
        p.warn(
            "the elements fill their memory: from here on none is divided further (see memory "
            "of integrator particle)");
      if (!p.progress(double(next - first) / double(last - first))) return false;
      if (p.seconds > 0 && next < last && now() - start > kShareOfTime * p.seconds) {
        p.warn("half of the time was enough for " + std::to_string(next - first) + " of " +
               std::to_string(last - first) + " particles");
        break;
      }
    }
    return true;
  }

  std::uint64_t particles_, part_, parts_;
  int samples_;
  HierarchySettings elements_;
  FootprintArea area_ = FootprintArea::covariance;
  FootprintSettings footprint_;
  std::string save_;
  std::vector<std::string> load_;
  std::unique_ptr<Hierarchy> hierarchy_;
  Viewing view_;
};

}  // namespace
}  // namespace vestige::particle

VESTIGE_PLUGIN(vestige::Integrator, vestige::particle::ParticleIntegrator)
