// SPDX-License-Identifier: Apache-2.0
// The panel beside the picture, the status line, and what the text has to be told.
#include <fmt/format.h>
#include <imgui.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/terminal.h"
#include "app/window/layers.h"

namespace vestige::app {
namespace {

/// A path is told as it was given; but one in another folder than this one is long.
std::string shortened(std::string text) {
  std::error_code failed;
  const std::string here = std::filesystem::current_path(failed).string() + '/';
  for (std::size_t at; (at = text.find(here)) != text.npos;) text.erase(at, here.size());
  return text;
}

constexpr float kPanel = 350, kStatus = 26;
constexpr int kTexturePixels = 220;
constexpr double kMostPixels = 16384;  ///< of a side of the film
const char* const kBounds[] = {"as traced", "pixel", "local", "global", "safe"};
constexpr Bound kBoundValues[] = {Bound::none, Bound::pixel, Bound::local, Bound::global,
                                  Bound::safe};

constexpr const char* kHelp = R"(left drag      turn around what is looked at
right drag     look around
middle drag, shift + left drag   move sideways
wheel          nearer, farther
W A S D E X    walk, rise, sink
F, click       look there, and make it sharp
click          inspect the path of that pixel
Z              undo a movement     Home  the text's camera
C              the camera as text, to the clipboard

ctrl + wheel   zoom the picture    0  fit    1  one to one
ctrl + drag    move the picture
R, drag        render a part       Escape  all again
Space          pause
. ,            exposure up, down
B              keep this picture   V  beside it / difference
P              save the picture    F12  save the window
F5             read the scene again
Tab            hide the panels     H  this help
ctrl + Q       close)";

/// Resident memory of this process, bytes.
double memory() {
  double pages = 0;
  if (FILE* f = std::fopen("/proc/self/statm", "r")) {
    double all = 0;
    if (std::fscanf(f, "%lf %lf", &all, &pages) != 2) pages = 0;
    std::fclose(f);
  }
  return pages * double(sysconf(_SC_PAGESIZE));
}

std::string bytesText(double bytes) {
  return bytes > 1e9 ? fmt::format("{:.2f} GB", bytes / 1e9)
                     : fmt::format("{:.0f} MB", bytes / 1e6);
}

void text(const std::string& s) { ImGui::TextUnformatted(s.c_str()); }
void wrapped(const std::string& s) { ImGui::TextWrapped("%s", s.c_str()); }

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

float panelWidth() { return kPanel * ImGui::GetIO().FontGlobalScale; }
float statusHeight() { return kStatus * ImGui::GetIO().FontGlobalScale; }

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
  std::vector<std::string> layers;
  for (int i = 0; i < kAovs; ++i) layers.push_back(name(Aov(i)));
  layers.push_back("element edges");
  std::string chosen = layer_ > 0 ? layers[std::size_t(layer_ - 1)] : "";
  if (choose("shows", layers, chosen, "radiance")) {
    layer_ = 0;
    for (std::size_t i = 0; i < layers.size(); ++i)
      if (layers[i] == chosen) layer_ = int(i) + 1;
    wish_.aovs.clear();
    if (layer_ == kElementEdges)
      wish_.aovs = {Aov::elementId, Aov::elementLevel};
    else if (layer_ > 0)
      wish_.aovs = {Aov(layer_ - 1)};
    restart(wish_.picture);
  }
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
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("to save to: .exr and .hdr keep radiance");
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
}

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
  const float wide = float(kTexturePixels) * ImGui::GetIO().FontGlobalScale;
  ImGui::Image(reinterpret_cast<ImTextureID>(std::intptr_t(texture_)), {wide, wide});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle = {corner.x + wide / 2, corner.y + wide / 2};
  const float k = wide / float(side);
  ImVec2 last;
  for (int s = 0; s <= 48; ++s) {
    const Real t = 2 * kPi * Real(s) / 48;
    const Vec2 p = Real(0.5) * std::cos(t) * a + Real(0.5) * std::sin(t) * b;
    const ImVec2 at = {middle.x + k * float(p.x), middle.y - k * float(p.y)};
    if (s > 0) list.AddLine(last, at, IM_COL32(80, 220, 255, 255), 2);
    last = at;
  }
}

void Window::drawComplaints() {
  if (!preview_) return;
  const Status s = preview_->status();
  if (s.complaints.empty() || (hidesWarnings_ && !s.isWrong)) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({12, 12}, ImGuiCond_Always);
  ImGui::SetNextWindowSizeConstraints(
      {0, 0}, {std::max(200.f, size.x - panelWidth() - 24), std::max(80.f, size.y * 0.6f)});
  ImGui::SetNextWindowBgAlpha(0.88f);
  ImGui::PushStyleColor(ImGuiCol_Border,
                        s.isWrong ? IM_COL32(255, 80, 60, 255) : IM_COL32(230, 180, 60, 255));
  bool isOpen = true;
  ImGui::Begin(s.isWrong ? "Not what is wanted: an older picture is shown###complaints"
                         : "The scene has warnings###complaints",
               s.isWrong ? nullptr : &isOpen,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_HorizontalScrollbar);
  int shown = 0;
  for (const Complaint& c : s.complaints) {
    if (++shown > 6) {
      text(fmt::format("... and {} more", s.complaints.size() - 6));
      break;
    }
    ImGui::PushID(shown);
    ImGui::PushStyleColor(ImGuiCol_Text, c.severity == Severity::error
                                             ? IM_COL32(255, 150, 130, 255)
                                             : IM_COL32(255, 220, 130, 255));
    text(shortened(c.text));
    ImGui::PopStyleColor();
    if (c.place.line > 0) {
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("click: open in the editor");
      if (ImGui::IsItemClicked()) openInEditor(c.place);
    }
    ImGui::PopID();
  }
  ImGui::End();
  ImGui::PopStyleColor();
  if (!isOpen) hidesWarnings_ = true;
}

void Window::drawStatus() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, size.y - statusHeight()});
  ImGui::SetNextWindowSize({size.x, statusHeight()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8, 5});
  ImGui::Begin(
      "status", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  std::string line;
  if (preview_) {
    const Status s = preview_->status();
    line = s.phase;
    if (s.phase == "preparing") line += fmt::format(" {:.0f} %", 100 * s.share);
    if (snapshot_) line += fmt::format("   {}", count(snapshot_->samples, "sample"));
    if (s.wanted > 0 && s.phase == "rendering") line += fmt::format(" of {}", s.wanted);
    if (s.remaining >= 0 && s.phase == "rendering")
      line += fmt::format("   {} left", durationText(s.remaining));
    if (snapshot_) line += fmt::format("   {}", durationText(snapshot_->seconds));
    if (const double noise = noiseOf(shown_); snapshot_ && layer_ == 0 && noise > 0)
      line += fmt::format("   noise {:.3f}", noise);
    if (s.raysPerSecond > 0) line += fmt::format("   {:.2f} Mrays/s", s.raysPerSecond / 1e6);
    line += fmt::format("   first picture {:.0f} ms", 1000 * s.firstPicture);
  }
  line += fmt::format("   {} x {}   {:.0f} %   {}", sheet_.width, sheet_.height,
                      100.0 * double(sheet_.zoom), bytesText(memory()));
  if (glfwGetTime() < messageUntil_) line = message_;
  text(line);
  ImGui::SameLine(size.x - 70);
  text("H: help");
  ImGui::End();
  ImGui::PopStyleVar();
}

void Window::drawHelp() {
  ImGui::Begin("Keys and mouse", &showsHelp_,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  text(kHelp);
  ImGui::End();
}

}  // namespace vestige::app
