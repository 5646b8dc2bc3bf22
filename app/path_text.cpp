// SPDX-License-Identifier: Apache-2.0
#include "app/path_text.h"

#include <fmt/format.h>
#include <vestige/tools/path_report.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/terminal.h"

namespace vestige::app {
namespace {

using Json = nlohmann::ordered_json;

std::string text(Real x) { return fmt::format("{:.4g}", double(x)); }
std::string text(Vec3 v) { return fmt::format("<{}, {}, {}>", text(v.x), text(v.y), text(v.z)); }
std::string text(Rgb c) { return text(Vec3{c.r, c.g, c.b}); }

/// "sphere with brdf phong (hello.scene:12)".
std::string objectText(const Surface& s, const LoadedScene& loaded) {
  const ObjectInfo& o = loaded.scene->object(s.object);
  const lang::Place at = lang::locate(o.span, *loaded.text.sources);
  std::string t = o.shape;
  if (!o.brdf.empty()) t += " with brdf " + o.brdf;
  if (at.line > 0) t += fmt::format(" ({}:{})", at.file, at.line);
  return t;
}

/// Between surfaces.
bool isGone(const PathVertex& v) {
  const std::string event = v.event;
  return event == "escape" || event == "roulette";
}

std::string eventText(const PathVertex& v) {
  const std::string event = v.event;
  if (event == "escape") return "leaves the scene along " + text(-v.toPrev);
  if (event == "roulette") return "ends by Russian roulette: too little was left of it";
  if (event == "pass") return "passes through: the surface is partly transparent";
  if (event == "absorbed") return "is absorbed";
  if (event == "end") return "ends: longest path";
  const ScatterSample& s = *v.scattered;
  std::string t =
      s.specular ? "goes on, specular" : fmt::format("scatters, pdf {} 1/sr", text(s.pdf));
  if (s.lobeChance < 1)
    t += fmt::format(", lobe {} drawn with chance {}", s.lobe, text(s.lobeChance));
  return t;
}

/// What each bound would grant the numbers here.
std::string boundsText(const PathCount& count) {
  const auto of = [&](Bound b) {
    DeltaPolicy p;
    p.bound = b;
    return text(commonDelta(p, count));
  };
  return fmt::format(
      "pixel {0} for the film, local {0} for the film and 1 after it, global {1}, "
      "safe {2}; a limit of 0.7 grants 0.7/|g| at most",
      of(Bound::local), of(Bound::global), of(Bound::safe));
}

std::string differentialsText(const VertexDifferentials& d, const std::vector<std::string>& names) {
  std::string t = fmt::format("    {:<12}{:>11}{:>11}{:>11}{:>11}{:>13}\n", "number", "|dV|",
                              "|dD|", "g", "delta", "delta |dV|");
  for (int j = 0; j < d.size; ++j) {
    const Real v = length(d.dVertex[j]);
    t += fmt::format("    {:<12}{:>11}{:>11}{:>11}{:>11}{:>13}\n", names[std::size_t(j)], text(v),
                     text(length(d.dDirection[j])), text(d.gradient[j]), text(d.delta[j]),
                     text(d.delta[j] * v));
  }
  return t;
}

std::string footprintText(const PathVertex& v) {
  const VertexDifferentials& d = v.differentials;
  const Footprint& f = d.footprint;
  std::string t = fmt::format("    footprint   dA {}  dB {}\n", text(f.dP[0]), text(f.dP[1]));
  t += fmt::format("                {} x {} scene units; exact area of all numbers {}\n",
                   text(length(f.dP[0])), text(length(f.dP[1])), text(d.area));
  if (v.texels.x > 0) {
    const auto texels = [&](Vec2 uv) {
      return text(std::hypot(uv.x * v.texels.x, uv.y * v.texels.y));
    };
    t += fmt::format("                {} x {} texels of its finest texture\n", texels(f.dUv[0]),
                     texels(f.dUv[1]));
  }
  return t;
}

std::string vertexText(std::size_t k, const PathVertex& v, const std::vector<std::string>& names,
                       const LoadedScene& loaded) {
  if (isGone(v))
    return fmt::format("{}  {}\n    throughput  {}\n", k, eventText(v), text(v.throughput));
  std::string t = fmt::format(
      "{}  {}\n    at          {}, {} from the last point\n", k, objectText(v.surface, loaded),
      text(v.surface.position + loaded.scene->view().middle), text(v.surface.distance));
  t +=
      fmt::format("    throughput  {} on arrival; the path {}\n", text(v.throughput), eventText(v));
  const VertexDifferentials& d = v.differentials;
  if (d.size == 0) return t + "    carries no differentials\n";
  t += fmt::format("    counts      M {} numbers so far, N_eff {} paths like this one\n",
                   d.count.variables(), text(d.count.effective()));
  t += fmt::format("    bounds      {}\n", boundsText(d.count));
  return t + differentialsText(d, names) + footprintText(v);
}

Json json(Vec3 v) { return {v.x, v.y, v.z}; }

Json differentialsJson(const VertexDifferentials& d, const std::vector<std::string>& names) {
  Json list = Json::array();
  for (int j = 0; j < d.size; ++j)
    list.push_back({{"number", names[std::size_t(j)]},
                    {"dV", json(d.dVertex[j])},
                    {"dD", json(d.dDirection[j])},
                    {"g", d.gradient[j]},
                    {"delta", d.delta[j]}});
  return list;
}

Json vertexJson(const PathVertex& v, const std::vector<std::string>& names,
                const LoadedScene& loaded) {
  Json j = {{"event", v.event}, {"throughput", {v.throughput.r, v.throughput.g, v.throughput.b}}};
  if (isGone(v)) return j["direction"] = json(-v.toPrev), j;
  const ObjectInfo& o = loaded.scene->object(v.surface.object);
  j["shape"] = o.shape, j["brdf"] = o.brdf;
  j["position"] = json(v.surface.position + loaded.scene->view().middle),
  j["distance"] = v.surface.distance;
  j["normal"] = json(v.surface.normal), j["uv"] = {v.surface.uv.x, v.surface.uv.y};
  if (v.scattered)
    j["scatter"] = {{"lobe", v.scattered->lobe},
                    {"chance", v.scattered->lobeChance},
                    {"specular", v.scattered->specular},
                    {"pdf", v.scattered->pdf}};
  const VertexDifferentials& d = v.differentials;
  if (d.size == 0) return j;
  j["variables"] = d.count.variables(), j["n_eff"] = d.count.effective();
  j["differentials"] = differentialsJson(d, names);
  const Footprint& f = d.footprint;
  j["footprint"] = {{"dA", json(f.dP[0])},
                    {"dB", json(f.dP[1])},
                    {"dA_uv", {f.dUv[0].x, f.dUv[0].y}},
                    {"dB_uv", {f.dUv[1].x, f.dUv[1].y}},
                    {"size", sideOf(f)},
                    {"exact_area", d.area}};
  if (v.texels.x > 0) j["footprint"]["texels"] = texelSideOf(f, v.texels);
  return j;
}

Json json(const PathNote& note) {
  if (note.count == 1) return note.values[0];
  return std::vector<double>(note.values, note.values + note.count);
}

/// A whole number with all its digits: it may be an id.
std::string numberText(double x) {
  return x == std::floor(x) && std::abs(x) < 1e15 ? fmt::format("{:.0f}", x)
                                                  : fmt::format("{:.4g}", x);
}

}  // namespace

std::string noteText(const PathNote& note) {
  std::vector<std::string> numbers;
  for (int i = 0; i < note.count; ++i) numbers.push_back(numberText(note.values[i]));
  std::string value = fmt::format("{}", fmt::join(numbers, ", "));
  if (note.count > 1) value = fmt::format("<{}>", value);
  const std::string unit = note.unit;
  return fmt::format("{} {}{}{}", note.name, value, unit.empty() ? "" : " ", unit);
}

std::string notesText(const RecordedPath& path, std::size_t vertex) {
  std::vector<std::string> texts;
  for (const RecordedPath::Note& n : path.notes)
    if (n.vertex == vertex) texts.push_back(noteText(n.note));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::vector<std::vector<std::string>> numberNames(const std::vector<PathVertex>& vertices) {
  static const char* const camera[] = {"film x", "film y", "lens u", "lens v"};
  std::vector<std::vector<std::string>> all;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::size_t size = std::size_t(vertices[k].differentials.size);
    const bool drew = k > 0 && vertices[k - 1].scattered && !vertices[k - 1].scattered->specular;
    const std::size_t added = drew ? 2 : 0;
    if (k == 0) {
      names.assign(camera, camera + std::min<std::size_t>(size, 4));
    } else if (size != names.size() + added && size >= added) {
      names.clear();  // reduced on the way
      for (std::size_t j = 0; j + added < size; ++j)
        names.push_back(fmt::format("mixed {}", j + 1));
    }
    if (drew)
      for (const char* u : {"u", "v"}) names.push_back(fmt::format("vertex {} {}", k, u));
    all.push_back(names);
  }
  return all;
}

std::string pathText(const RecordedPath& path, const LoadedScene& loaded) {
  const auto names = numberNames(path.vertices);
  std::string t;
  for (std::size_t k = 0; k < path.vertices.size(); ++k) {
    t += fmt::format("\n{}", vertexText(k + 1, path.vertices[k], names[k], loaded));
    if (const std::string notes = notesText(path, k); !notes.empty())
      t += fmt::format("    notes       {}\n", notes);
  }
  return t;
}

std::string pathJson(const RecordedPath& path, const LoadedScene& loaded, Rgb radiance) {
  const auto names = numberNames(path.vertices);
  Json vertices = Json::array();
  for (std::size_t k = 0; k < path.vertices.size(); ++k)
    vertices.push_back(vertexJson(path.vertices[k], names[k], loaded));
  for (const RecordedPath::Note& n : path.notes)
    if (n.vertex < vertices.size()) vertices[n.vertex]["notes"][n.note.name] = json(n.note);
  const Json all = {{"radiance", {radiance.r, radiance.g, radiance.b}}, {"vertices", vertices}};
  return all.dump(2);
}

}  // namespace vestige::app
