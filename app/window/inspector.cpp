// SPDX-License-Identifier: Apache-2.0
// The panel of the path that was clicked: its vertices, their footprints, and the texture below.
#include <fmt/format.h>

#include <cmath>

#include "app/window/widgets.h"
#include "app/window/window.h"

namespace vestige::app {
namespace {

constexpr int kTexturePixels = 220;
const char* const kBounds[] = {"as traced", "pixel", "local", "global", "safe"};
constexpr Bound kBoundValues[] = {Bound::none, Bound::pixel, Bound::local, Bound::global,
                                  Bound::safe};

}  // namespace

void Window::drawInspectorPanel() {
  if (!ImGui::CollapsingHeader("Path and footprints", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const Inspection& i = *inspection_;
  text(fmt::format("pixel {}, {}: <{:.3g}, {:.3g}, {:.3g}>", i.x, i.y, i.radiance.r, i.radiance.g,
                   i.radiance.b));
  auto sample = int(i.sample);
  if (ImGui::InputInt("sample", &sample, 1, 16) && sample >= 0)
    preview_->inspect(i.x, i.y, std::uint32_t(sample));
  if (i.path.vertices.empty()) {
    return wrapped(
        fmt::format("the path left the scene at once, or integrator {} tells nothing "
                    "about its paths",
                    i.open->loaded.scene ? snapshot_->integrator : ""));
  }
  if (ImGui::Combo("bound", &boundChoice_, kBounds, IM_ARRAYSIZE(kBounds))) isTextureStale_ = true;
  reckoning_.bound.reset();
  if (boundChoice_ > 0) {
    reckoning_.bound = kBoundValues[boundChoice_];
    isTextureStale_ |= ImGui::SliderInt("of samples", &reckoning_.samples, 1, 4096, "%d",
                                        ImGuiSliderFlags_Logarithmic);
    auto limit = float(std::min(reckoning_.limit, Real(10)));
    if (ImGui::SliderFloat("limit", &limit, 0.05f, 10, limit < 10 ? "%.2f" : "off",
                           ImGuiSliderFlags_Logarithmic)) {
      reckoning_.limit = limit < 10 ? Real(limit) : kInfinity;
      isTextureStale_ = true;
    }
  }
  const auto names = numberNames(i.path.vertices);
  for (std::size_t k = 0; k < i.path.vertices.size(); ++k) drawVertex(k, names[k]);
  drawTexturePanel();
}

void Window::drawVertex(std::size_t k, const std::vector<std::string>& names) {
  const Inspection& i = *inspection_;
  const PathVertex& v = i.path.vertices[k];
  if (v.surface.object < 0) return text(fmt::format("{}  {}", k + 1, v.event));
  const ObjectInfo& o = i.open->loaded.scene->object(v.surface.object);
  const bool isChosen = int(k) == vertex_;
  const std::string title =
      fmt::format("{}  {} {}: {}###vertex{}", k + 1, o.shape, o.brdf, v.event, k);
  ImGui::SetNextItemOpen(isChosen, ImGuiCond_Always);
  const bool isOpen = ImGui::TreeNodeEx(title.c_str(), isChosen ? ImGuiTreeNodeFlags_Selected : 0);
  if (ImGui::IsItemClicked()) vertex_ = int(k), isTextureStale_ = true;
  if (!isOpen) return;
  const VertexDifferentials& d = v.differentials;
  const Region3 r = regionOf(v, reckoning_);
  if (d.size == 0) {
    text("carries no differentials");
  } else {
    text(fmt::format("M {}   N_eff {:.4g}", d.count.variables(), d.count.effective()));
    text("number         |dV|      g    delta");
    for (int j = 0; j < d.size; ++j)
      text(fmt::format("{:<12}{:>8.3g}{:>8.2g}{:>8.3g}", names[std::size_t(j)],
                       length(d.dVertex[j]), d.gradient[j], r.deltas[std::size_t(j)]));
    text(fmt::format("|dA| {:.4g}  |dB| {:.4g}  area {:.4g}", length(r.a), length(r.b), r.area));
    if (v.texels.x > 0) {
      const auto texels = [&](Vec2 uv) { return std::hypot(uv.x * v.texels.x, uv.y * v.texels.y); };
      text(fmt::format("{:.3g} x {:.3g} texels", texels(r.footprint.dUv[0]),
                       texels(r.footprint.dUv[1])));
    }
  }
  ImGui::TreePop();
}

/// The texture at the chosen vertex, and what of it the path stands for.
void Window::drawTexturePanel() {
  const Inspection& i = *inspection_;
  if (vertex_ >= int(i.path.vertices.size())) return;
  const PathVertex& v = i.path.vertices[std::size_t(vertex_)];
  if (v.surface.object < 0) return;
  const Region3 r = regionOf(v, reckoning_);
  const Vec2 a = r.footprint.dUv[0], b = r.footprint.dUv[1];
  const Real size = std::max({std::hypot(a.x, a.y), std::hypot(b.x, b.y), Real(1e-5)});
  const Real side = Real(textureZoom_) * size;
  if (isTextureStale_) {
    isTextureStale_ = false;
    const Image image =
        textureAround(*i.open->loaded.scene, v.surface, {v.surface.uv, side}, kTexturePixels);
    if (texture_) gl::DeleteTextures(1, &texture_);
    texture_ = 0;
    if (image.width > 0) {
      std::vector<float> codes = image.pixels;
      std::string ignored;
      applyDisplay(look_.display, codes.data(), codes.size() / 3, 3, ignored);
      gl::GenTextures(1, &texture_);
      gl::BindTexture(GL_TEXTURE_2D, texture_);
      gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
      gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width, image.height, 0, GL_RGB, GL_FLOAT,
                     codes.data());
    }
  }
  if (!texture_) return text("no texture there");
  if (ImGui::SliderFloat("around", &textureZoom_, 1.5f, 1000, "%.1f times",
                         ImGuiSliderFlags_Logarithmic))
    isTextureStale_ = true;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float wide = float(kTexturePixels) * scale_;
  ImGui::Image(reinterpret_cast<ImTextureID>(std::intptr_t(texture_)), {wide, wide});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle = {corner.x + wide / 2, corner.y + wide / 2};
  const float k = wide / float(side);
  ImVec2 last;
  for (int s = 0; s <= 48; ++s) {
    const Real t = 2 * kPi * Real(s) / 48;
    const Vec2 p = Real(0.5) * std::cos(t) * a + Real(0.5) * std::sin(t) * b;
    const ImVec2 at = {middle.x + k * float(p.x), middle.y - k * float(p.y)};
    if (s > 0) list.AddLine(last, at, IM_COL32(80, 220, 255, 255), 2 * scale_);
    last = at;
  }
}

}  // namespace vestige::app
