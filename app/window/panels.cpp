// SPDX-License-Identifier: Apache-2.0
// The panel beside the picture: how it is made, seen and compared.
#include <fmt/format.h>

#include <cmath>

#include "app/terminal.h"
#include "app/window/layers.h"
#include "app/window/widgets.h"

namespace vestige::app {
namespace {

constexpr double kMostPixels = 16384;  ///< of a side of the film

/// A menu of words; true when another one was chosen.
bool choose(const char* label, const std::vector<std::string>& words, std::string& chosen,
            const std::string& none) {
  bool isNew = false;
  if (!ImGui::BeginCombo(label, chosen.empty() ? none.c_str() : chosen.c_str())) return false;
  if (!none.empty() && ImGui::Selectable(none.c_str(), chosen.empty()))
    isNew = !chosen.empty(), chosen.clear();
  for (const std::string& w : words)
    if (ImGui::Selectable(w.c_str(), w == chosen)) isNew = w != chosen, chosen = w;
  ImGui::EndCombo();
  return isNew;
}

}  // namespace

void Window::drawPanels() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - panelWidth(), 0});
  ImGui::SetNextWindowSize({panelWidth(), size.y - statusHeight()});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(panelWidth() * 0.58f);
  drawPicturePanel();
  if (preview_) drawLightPanel();
  if (preview_) drawCameraPanel();
  drawComparePanel();
  drawPixelPanel();
  if (inspection_) drawInspectorPanel();
  ImGui::PopItemWidth();
  ImGui::End();
  drawStatus();
  drawComplaints();
  if (showsHelp_) drawHelp();
}

void Window::drawPicturePanel() {
  if (!ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) return;
  bool isNew = false;
  std::vector<std::string> names;
  for (const DisplayViews& d : displays_) names.push_back(d.display);
  if (displays_.empty()) text("the colour config has no display");
  if (names.size() > 1) isNew |= choose("display", names, look_.display.display, names[0]);
  for (const DisplayViews& d : displays_)
    if (d.display == (look_.display.display.empty() ? names[0] : look_.display.display))
      isNew |= choose("view", d.views, look_.display.view, d.views.empty() ? "" : d.views[0]);
  auto exposure = float(look_.display.exposure);
  if (ImGui::SliderFloat("exposure", &exposure, -8, 8, "%.2f stops"))
    look_.display.exposure = double(exposure), isNew = true;
  if (isNew) {
    std::string error;
    if (!screen_->setDisplay(look_.display, error)) say(error);
  }
  ImGui::SliderFloat("gamma", &look_.gamma, 0.4f, 3);
  int channel = int(look_.channel);
  if (ImGui::Combo("channel", &channel, "all\0red\0green\0blue\0luminance\0false colour\0"))
    look_.channel = Channel(channel);
  if (!preview_) return;
  std::vector<std::string> layers = snapshot_ ? snapshot_->aovs : aovNames();
  if (std::find(layers.begin(), layers.end(), kElementId) != layers.end())
    layers.push_back(kElementEdges);
  if (!choose("shows", layers, layer_, "radiance")) return;
  wish_.aovs.clear();
  if (!layer_.empty()) wish_.aovs = {layer_ == kElementEdges ? kElementId : layer_};
  restart(wish_.picture);
}

void Window::drawLightPanel() {
  if (!ImGui::CollapsingHeader("Rendering", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (open_ && choose("integrator", open_->integrators, wish_.build.integrator, "the scene's"))
    restart(wish_.way);
  static const std::vector<std::string> bounds = {"none", "pixel",    "local", "global",
                                                  "safe", "gradient", "paper"};
  if (choose("footprint", bounds, wish_.build.footprint, "the scene's")) restart(wish_.way);
  int samples = wish_.samples;
  if (ImGui::InputInt("samples", &samples, 16, 64, ImGuiInputTextFlags_EnterReturnsTrue)) {
    wish_.samples = std::clamp(samples, 0, kMostSamples);
    preview_->want(wish_);
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a pixel; 0: what the scene says");
  int width = sheet_.width;
  if (ImGui::InputInt("width", &width, 64, 256, ImGuiInputTextFlags_EnterReturnsTrue)) {
    // The other side follows from the film's shape, and must not be larger either.
    const double most =
        kMostPixels * std::min(1.0, double(sheet_.width) / std::max(1, sheet_.height));
    wish_.width = std::clamp(width, 1, std::max(1, int(most))), wish_.height = 0;
    isFitted_ = true;
    restart(wish_.picture);
  }
  if (ImGui::Button(wish_.isPaused ? "go on" : "pause")) {
    wish_.isPaused = !wish_.isPaused;
    preview_->want(wish_);
  }
  ImGui::SameLine();
  if (ImGui::Button("read again")) restart(wish_.reload);
  ImGui::SameLine();
  if (ImGui::Button(wish_.region ? "whole picture" : "region")) {
    if (wish_.region)
      wish_.region.reset(), restart(wish_.picture);
    else
      onKey(GLFW_KEY_R, 0);
  }
}

void Window::drawCameraPanel() {
  if (!ImGui::CollapsingHeader("Camera")) return;
  const auto block = camera();
  if (!block) return;
  const auto view = viewOf(*block, cameraSchema());
  text("camera " + block->plugin);
  if (!view) return text("it has no location and look_at to move");
  const auto row = [](const char* label, Vec3 v) {
    text(fmt::format("{:<9} <{:.4g}, {:.4g}, {:.4g}>", label, v.x, v.y, v.z));
  };
  row("location", view->location);
  row("look_at", view->lookAt);
  for (const char* number : {"angle", "aperture", "focus_distance"}) {
    const Block inHand = placed(*block, cameraSchema());
    const auto value = numberOf(inHand, cameraSchema(), number);
    if (!value) continue;
    const Parameter& row = *cameraSchema().find(number);
    auto x = float(*value);
    if (ImGui::DragFloat(number, &x, std::max(0.001f, std::abs(x) * 0.01f), 0, 0, "%.4g")) {
      keepForUndo();
      useCamera(withNumber(inHand, number, std::clamp(double(x), row.low, row.high)));
    }
  }
  if (ImGui::Button("copy as text")) onKey(GLFW_KEY_C, 0);
  ImGui::SameLine();
  if (ImGui::Button("focus at ...")) onKey(GLFW_KEY_F, 0);
  ImGui::SameLine();
  if (ImGui::Button("undo")) undo();
  ImGui::SameLine();
  if (ImGui::Button("text's")) onKey(GLFW_KEY_HOME, 0);
}

void Window::drawComparePanel() {
  if (!ImGui::CollapsingHeader("Compare, save")) return;
  ImGui::InputText("##save", file_, sizeof file_);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "to save to: .exr and .hdr keep radiance, .checkpoint what `vestige render` goes on from");
  ImGui::SameLine();
  if (ImGui::Button("save")) savePicture(file_);
  ImGui::InputText("##compare", reference_, sizeof reference_);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a picture to compare with");
  ImGui::SameLine();
  if (ImGui::Button("compare")) openReference(reference_);
  if (ImGui::Button("keep this picture")) keepAsOther();
  if (other_.width == 0) return;
  wrapped("beside: " + otherName_);
  int versus = int(look_.versus);
  if (ImGui::Combo("show", &versus, "this one\0both, with a wipe\0difference\0"))
    look_.versus = Versus(versus);
  if (look_.versus == Versus::wipe) ImGui::SliderFloat("wipe", &look_.wipe, 0, 1);
  if (ImGui::Button("FLIP")) makeFlip();
}

void Window::drawPixelPanel() {
  if (!ImGui::CollapsingHeader("Pixel under the cursor", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const auto [x, y] = cursor();
  const auto at = pixelAt(x, y);
  if (!at || shown_.width == 0) return text("beside the picture\n ");
  const Film::Means* means = snapshot_ ? &snapshot_->means : nullptr;
  const int scale = snapshot_ ? snapshot_->scale : 1;
  const Crop crop = snapshot_ ? snapshot_->crop : Crop{};
  const int px = int(at->x) / scale - crop.x0, py = int(at->y) / scale - crop.y0;
  text(fmt::format("{}, {}", int(at->x), int(at->y)));
  if (px < 0 || py < 0 || px >= shown_.width || py >= shown_.height) return;
  if (!means) {
    const float* c = &shown_.rgb[(std::size_t(py) * shown_.width + px) * 3];
    return text(fmt::format("{:.5g}  {:.5g}  {:.5g}", c[0], c[1], c[2]));
  }
  const std::size_t stride = means->channels.size();
  const float* c = &means->pixels[(std::size_t(py) * means->width + px) * stride];
  text(fmt::format("radiance {:.5g}  {:.5g}  {:.5g}", c[0], c[1], c[2]));
  for (std::size_t i = 3; i < stride; ++i)
    text(fmt::format("{} {:.10g}", means->channels[i], c[i]));
  drawNotes(int(at->x), int(at->y));
}

/// The notes of the integrator about the point under the cursor. A path is traced for them.
void Window::drawNotes(int x, int y) {
  if (x != hoverX_ || y != hoverY_ || snapshot_ != hoverOver_.lock()) {
    hoverX_ = x, hoverY_ = y, hoverOver_ = snapshot_;
    preview_->hover(x, y);
  }
  if (!hovered_ || hovered_->path.notes.empty()) return;
  if (hovered_->x != x || hovered_->y != y) return text("notes ...\n\n");
  const std::size_t vertex = hovered_->path.notes.front().vertex;
  if (vertex > 0) text(fmt::format("at vertex {}", vertex + 1));
  for (const RecordedPath::Note& n : hovered_->path.notes)
    if (n.vertex == vertex) text(noteText(n.note));
}

}  // namespace vestige::app
